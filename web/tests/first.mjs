// Time to the first picture of every example and template: `node web/tests/first.mjs [name...]`, with the release build. Prints when the
// readout of the operating point, the first curve, its orbit and the end of the search are on the page, and what is shown by then.
import { readdir } from "node:fs/promises";
import { browse, serve, templates } from "./browser.mjs";

const examples = new URL("../../examples/", import.meta.url).pathname;
const wanted = process.argv.slice(2);
const browser = await browse();
const names = (await readdir(examples)).sort();
const specs = [...names.map((name) => ({ example: `${name}/${name.startsWith("bouncing") ? "impact" : "harvester"}.toml` })), ...templates().map((kind) => ({ kind }))];
console.log("spec, drawing s, readout s, curve s, orbit s, search s, status");
for (const spec of specs.filter((own) => wanted.length === 0 || wanted.some((name) => (own.example ?? own.kind).includes(name)))) {
    const server = await serve(spec);
    const page = await browser.context.newPage();
    const start = performance.now();
    const after = async (condition) => {
        await page.waitForFunction(condition, undefined, { timeout: 90_000, polling: 50 }).catch(() => {});
        return ((performance.now() - start) / 1000).toFixed(1);
    };
    await page.goto(server.address);
    const times = await Promise.all([
        after(() => document.querySelector("#side > svg")),
        after(() => /reached by|on average/.test(document.getElementById("operating-words").textContent)),
        after(() => document.body.classList.contains("aperiodic") || /Draft|Peak|Largest|No periodic/.test(document.getElementById("readout").textContent)),
        after(() => /Orbit at|No /.test(document.getElementById("orbit-title").textContent)),
        after(() => document.querySelector("#side > svg") && !document.querySelector("[aria-busy=true]")),
    ]);
    console.log([spec.example ?? spec.kind, ...times, await page.locator("#status").textContent(), await page.locator("#operating-words").textContent(), await page.locator("#faults").textContent()].join(", "));
    await page.close();
    await server.close();
}
await browser.close();
