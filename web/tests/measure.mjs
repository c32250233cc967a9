// Times of the page in a real browser: `node web/tests/measure.mjs [moves]`, with the release build.
import { readFile } from "node:fs/promises";
import { browse, open, program, serve } from "./browser.mjs";

const moves = Number(process.argv[2] ?? 500);
const began = performance.now();
const server = await serve();
const browser = await browse();
const page = await browser.context.newPage();
const told = performance.now();
await page.goto(server.address);
await page.locator("#side > svg").waitFor();
const painted = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
await page.close();
const ready = await open(browser.context, server.address);
await ready.waitForTimeout(3000);
const statistics = (values) => {
    const sorted = [...values].sort((a, b) => a - b);
    const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]?.toFixed(1);
    return `median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, ${sorted.length} values`;
};
const times = (name) => ready.evaluate((wanted) => performance.getEntriesByName(wanted).map((entry) => entry.duration), name);
const slider = ready.getByRole("slider", { name: "stop.tip.gap", exact: true });
await ready.evaluate(() => performance.clearMeasures());
// Moves are made in the page itself, so that nothing but the page and its server is measured.
const cpuMs = async () => {
    const words = (await readFile(`/proc/${server.child.pid}/stat`, "utf8")).split(") ")[1].split(" ");
    return 10 * (Number(words[11]) + Number(words[12]));
};
const before = await cpuMs();
await slider.evaluate(async (element, count) => {
    for (let move = 0; move < count; move++) {
        element.value = String(300 + Math.round(60 * Math.sin(move / 25)));
        element.dispatchEvent(new Event("input"));
        await new Promise((resolve) => setTimeout(resolve, 60));
    }
}, moves);
const spent = await cpuMs();
await ready.waitForTimeout(1500);
const branch = await times("slider-to-branch");
const served = await ready.evaluate(() => performance.getEntriesByName("slider-to-branch").map((entry) => entry.detail));
const orbit = await times("click-to-orbit");
const frames = await ready.evaluate(() => new Promise((resolve) => {
    let count = 0;
    const start = performance.now();
    const tick = () => (performance.now() - start < 2000 ? (count++, requestAnimationFrame(tick)) : resolve(count / 2));
    requestAnimationFrame(tick);
}));
console.log(`program: ${program}`);
console.log(`address told after ${(told - began).toFixed(0)} ms with the browser's own start; first contentful paint ${painted?.toFixed(0)} ms`);
console.log(`slider to branch over ${moves} moves: ${statistics(branch)}`);
console.log(`of that on the server: ${statistics(served)}`);
console.log(`time of cores that the server took: ${((spent - before) / branch.length).toFixed(0)} ms for each branch with its drawing and orbit`);
console.log(`orbit after a choice: ${statistics(orbit)}`);
console.log(`frames per second: ${frames}`);
await browser.close();
await server.close();
