// Long dragging: `node web/tests/endure.mjs [minutes]`, with the release build. Prints memory of server and page every tenth of the time, and
// what the cores do afterwards.
import { readFile } from "node:fs/promises";
import { browse, open, ready, serve } from "./browser.mjs";

const minutes = Number(process.argv[2] ?? 10);
const server = await serve();
const browser = await browse();
const page = await open(browser.context, server.address);
const devtools = await browser.context.newCDPSession(page);

const stat = async () => (await readFile(`/proc/${server.child.pid}/stat`, "utf8")).split(") ")[1].split(" ");
/** Processor time of the server, s. */
const spent = async () => {
    const words = await stat();
    return (Number(words[11]) + Number(words[12])) / 100;
};
/** Memory of the server, MB. */
const resident = async () => Number((await readFile(`/proc/${server.child.pid}/status`, "utf8")).match(/VmRSS:\s+(\d+)/)[1]) / 1024;
/** Memory of the page after its rubbish is collected, MB. */
const heap = async () => {
    await devtools.send("HeapProfiler.collectGarbage");
    return (await devtools.send("Runtime.getHeapUsage")).usedSize / 2 ** 20;
};

const slider = page.getByRole("slider", { name: "stop.tip.gap", exact: true });
const drag = (ms) => slider.evaluate(async (element, until) => {
    const end = performance.now() + until;
    while (performance.now() < end) {
        element.value = String(300 + Math.round(120 * Math.sin(performance.now() / 1500)));
        element.dispatchEvent(new Event("input"));
        await new Promise((resolve) => setTimeout(resolve, 30));
    }
}, ms);
console.log("minutes, server MB, page MB");
for (let tenth = 0; tenth <= 10; tenth++) {
    if (tenth > 0) await drag(6000 * minutes);
    console.log(`${(0.1 * tenth * minutes).toFixed(1)}, ${(await resident()).toFixed(1)}, ${(await heap()).toFixed(1)}`);
}
await ready(page);
await page.waitForTimeout(2000);
const [before, began] = [await spent(), performance.now()];
await page.waitForTimeout(5000);
console.log(`server afterwards: ${(((await spent()) - before) / (performance.now() - began) * 1e5).toFixed(1)} % of a core`);
await page.close();

await browser.close();
await server.close();
