// Many pages at once: `node web/tests/many.mjs [pages] [repeats]`, with the release build. All pages open together, then move to the same
// design, then each to a design of its own. Prints when the last page has what it asked for: first for pages that only ask, so that
// the program is timed, then for complete pages, which the browser also has to draw. The smallest of the repeats is the figure.
import { readFile } from "node:fs/promises";
import { loadavg } from "node:os";
import { browse, ready, serve } from "./browser.mjs";
import { OPTIONS, connect } from "./designs.mjs";

const count = Number(process.argv[2] ?? 20);
const repeats = Number(process.argv[3] ?? 3);
const SPAN = { over: "drive.shaker.frequency", from: 11.44, to: 14.82 };
const GAP = "stop.tip.gap";

const list = [...Array(count).keys()];
const seconds = (ms) => `${(ms / 1000).toFixed(2)} s`;
/** Processor time of a server, ms. */
const spent = async ({ child }) => {
    const words = (await readFile(`/proc/${child.pid}/stat`, "utf8")).split(") ")[1].split(" ");
    return 10 * (Number(words[11]) + Number(words[12]));
};

/** Runs in a browser: many pages ask what a page asks for a design; for each result, when the last page has it, ms. */
async function visit({ sets, span }) {
    const asks = (window.asks ??= await Promise.all(sets.map(() => window.join())));
    const start = performance.now();
    const times = {};
    const note = (name, { at, head }) => {
        times[name] = Math.max(times[name] ?? 0, head.stage === "fault" ? Infinity : at - start);
    };
    const one = async (set, ask) => {
        const points = async () => {
            for (const starts of [12, 100]) note(`${starts} starts`, (await ask("operating-point", { set, starts }, ["done"]))[0]);
        };
        const response = async () => {
            const [coarse, fine] = await ask("response", { set, ...span }, ["coarse", "fine"]);
            note("curve", coarse);
            note("search", fine);
            note("orbit", (await ask("orbit", { response: fine.head.id, branch: 0, point: 0 }, ["done"]))[0]);
        };
        note("drawing", (await ask("design", { set }, ["done"]))[0]);
        await Promise.all([response(), points()]);
    };
    await Promise.all(sets.map((set, k) => one(set, asks[k])));
    return times;
}

/** Pages that only ask. */
async function asking(browser) {
    const server = await serve();
    const page = await browser.context.newPage();
    await connect(page, server.address);
    const together = async (name, setOf) => {
        const before = await spent(server);
        const times = await page.evaluate(visit, { sets: list.map(setOf), span: { ...SPAN, ...OPTIONS } });
        console.log(`  ${name}: ${Object.entries(times).map(([own, ms]) => `${own} ${seconds(ms)}`).join(", ")}; processor ${seconds((await spent(server)) - before)}`);
    };
    await together("opened", () => []);
    await together("the same move", () => [[GAP, "0.9 mm"]]);
    await together("moves of their own", (k) => [[GAP, `${0.8 + 0.01 * k} mm`]]);
    await page.close();
    await server.close();
}

/** Complete pages: the first curve, then all results. */
async function complete(browser) {
    const server = await serve();
    const before = await spent(server);
    const pages = await Promise.all(list.map(() => browser.context.newPage()));
    const times = await Promise.all(pages.map(async (page) => {
        const start = performance.now();
        await page.goto(server.address);
        await page.waitForFunction(() => /Draft|Peak|Largest/.test(document.getElementById("readout").textContent));
        const curve = performance.now() - start;
        await ready(page);
        return { curve, all: performance.now() - start };
    }));
    const last = (own) => seconds(Math.max(...times.map((one) => one[own])));
    console.log(`  opened: curve ${last("curve")}, search and orbit ${last("all")}; processor of the server ${seconds((await spent(server)) - before)}`);
    await Promise.all(pages.map((page) => page.close()));
    await server.close();
}

const browser = await browse();
for (const [name, run] of [["pages that only ask", asking], ["complete pages", complete]]) {
    for (let repeat = 0; repeat < repeats; repeat++) {
        console.log(`${count} ${name}, load ${loadavg()[0].toFixed(1)}`);
        await run(browser);
    }
}
await browser.close();
