// Times of the page in a real browser: `node web/tests/measure.mjs [moves] [spec...]`, with the release build. Moves of the gap on the spec
// of the paper, the template of a cantilever with a stop, and the two beams; the processor time of the server beside them, which other
// programs on the machine change least.
import { readFile } from "node:fs/promises";
import { loadavg } from "node:os";
import { browse, open, program, serve } from "./browser.mjs";
import { nameOf } from "./designs.mjs";

const moves = Number(process.argv[2] ?? 500);
const wanted = process.argv.slice(3);
const SPECS = [{}, { kind: "cantilever-with-stop" }, { example: "two-beams-vijayan-2015/harvester.toml" }];

const statistics = (values) => {
    const sorted = [...values].sort((a, b) => a - b);
    const at = (share) => sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))]?.toFixed(1);
    return `smallest ${at(0)} ms, median ${at(0.5)} ms, 95th percentile ${at(0.95)} ms, ${sorted.length} values`;
};

/** Time to the first drawing of a page. */
async function paint(browser, server) {
    const page = await browser.context.newPage();
    const began = performance.now();
    await page.goto(server.address);
    await page.locator("#side > svg").waitFor();
    const drawn = performance.now() - began;
    const painted = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0]?.startTime);
    await page.close();
    return `first contentful paint ${painted?.toFixed(0)} ms, drawing ${drawn.toFixed(0)} ms`;
}

/** Moves the slider of the gap in the page itself, so that nothing but the page and its server is measured. */
const move = (slider) => slider.evaluate(async (element, count) => {
    const middle = Number(element.value);
    for (let k = 1; k <= count; k++) {
        element.value = String(middle + Math.round(60 * Math.sin(k / 25)));
        element.dispatchEvent(new Event("input"));
        await new Promise((resolve) => setTimeout(resolve, 60));
    }
}, moves);

/** Runs in a page: counts its frames. */
const frames = () => new Promise((resolve) => {
    let count = 0;
    const start = performance.now();
    const tick = () => (performance.now() - start < 2000 ? (count++, requestAnimationFrame(tick)) : resolve(count / 2));
    requestAnimationFrame(tick);
});

async function measure(browser, spec) {
    const server = await serve(spec);
    const painted = await paint(browser, server);
    const page = await open(browser.context, server.address);
    await page.waitForTimeout(3000);
    await page.evaluate(() => performance.clearMeasures());
    const cpuMs = async () => {
        const words = (await readFile(`/proc/${server.child.pid}/stat`, "utf8")).split(") ")[1].split(" ");
        return 10 * (Number(words[11]) + Number(words[12]));
    };
    const before = await cpuMs();
    await move(page.getByRole("slider", { name: /^stop\..*\.gap$/ }).first());
    const spent = await cpuMs();
    const measures = (name) => page.evaluate((own) => performance.getEntriesByName(own).map(({ duration, detail }) => [duration, detail]), name);
    const branch = await measures("slider-to-branch");
    const orbit = await measures("click-to-orbit");
    console.log(`${nameOf(spec)}, load ${loadavg()[0].toFixed(1)}: ${painted}`);
    console.log(`  slider to branch over ${moves} moves: ${statistics(branch.map(([own]) => own))}`);
    console.log(`  of that on the server: ${statistics(branch.map(([, served]) => served))}`);
    console.log(`  processor time of the server: ${((spent - before) / branch.length).toFixed(0)} ms for each branch with its drawing and orbit`);
    console.log(`  orbit after a choice: ${statistics(orbit.map(([own]) => own))}`);
    console.log(`  frames per second: ${await page.evaluate(frames)}`);
    await page.close();
    await server.close();
}

console.log(`program: ${program}`);
const browser = await browse();
for (const spec of SPECS) if (wanted.length === 0 || wanted.some((name) => nameOf(spec).includes(name))) await measure(browser, spec);
await browser.close();
