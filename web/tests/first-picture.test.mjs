// What appears first, and what it needs: the closed form, then one run, then a few starts, then the search. No times: they depend on the machine.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { browse, inked, open, ready, serve } from "./browser.mjs";
import { gate } from "./gate.mjs";

let browser;
before(async () => {
    browser = await browse();
});
after(() => browser?.close());

/** Frames of everything that integrates. */
const INTEGRATED = "^(response (coarse|progress|fine|widths)|operating-point|shake|orbit)";

/** Opens the page of a spec with some frames held back. */
async function begin(options, held) {
    const server = await serve(options);
    const page = await browser.context.newPage();
    page.faults = [];
    page.on("pageerror", (error) => page.faults.push(String(error)));
    await page.addInitScript(gate, held);
    await page.goto(server.address);
    const text = (id) => page.locator(`#${id}`).textContent();
    const until = (id, pattern) => page.waitForFunction(([name, source]) => new RegExp(source).test(document.getElementById(name).textContent), [id, pattern.source]);
    const hold = (pattern) => page.evaluate((source) => {
        window.gate.open();
        if (source) window.gate.hold(source);
    }, pattern);
    const close = async () => {
        assert.deepEqual(page.faults, []);
        await page.close();
        await server.close();
    };
    return { server, page, text, until, hold, close };
}

/** The drawing and the curve without contact, marked as a draft, from the closed form. */
async function closedForm({ page, text, until }) {
    await page.locator("#side > svg").waitFor();
    await until("readout", /^Draft: without contact only/);
    assert.ok((await inked(page, "#chart-response canvas")) > 0.002);
    assert.match(await text("operating-words"), /^Operating point: integrating 10 starts$/);
    assert.equal(await text("orbit-title"), "Orbit: the operating point is being computed");
}

for (const example of ["missile-renaud-2009", "seismic-mass-jacquelin-2011"]) {
    test(`${example}: the drawing and a curve need no integration, the first power needs one run`, async () => {
        const own = await begin({ example: `${example}/harvester.toml` }, INTEGRATED);
        await closedForm(own);
        // Something computes, and says so.
        await own.until("busy", /^computing, [\d.]+ s$/);
        assert.ok(await own.page.locator("#response-stop").isVisible());
        await own.page.locator("#operating-stop").waitFor({ state: "visible" });
        // The starts of the operating point remain held.
        await own.hold("^(response (coarse|progress|fine|widths)|operating-point|orbit)");
        await own.until("operating-words", /^Under the drives of the spec: [\d.]+ .?W on average/);
        await own.close();
    });
}

test("a template with many branches: first picture, progress, Stop, and marks that leave the curves visible", async () => {
    const own = await begin({ kind: "cantilever-with-stop" }, INTEGRATED);
    const { page, text, until, hold } = own;
    await closedForm(own);
    await page.evaluate(() => {
        window.seen = [];
        const words = document.getElementById("operating-words");
        new MutationObserver(() => window.seen.push(words.textContent)).observe(words, { childList: true, characterData: true, subtree: true });
    });
    // A few starts before many of them, and the draft before the search.
    await hold("^response fine");
    await until("readout", /^Draft from a few orbits/);
    await until("operating-words", /^At 26 Hz: .* of 100 starts/);
    const seen = (await page.evaluate(() => window.seen)).map((words) => words.match(/^At 26 Hz: .* of (\d+) starts/)?.[1]).filter(Boolean);
    assert.deepEqual([...new Set(seen)], ["10", "100"]);
    await until("busy", /^draft, searching: \d+ of \d+ parts$/);
    assert.ok(await page.locator(".readout details").first().isHidden());
    await page.locator("#response-stop").click();
    assert.equal(await text("busy"), "draft, search stopped");
    assert.ok(await page.locator("#response-stop").isHidden());
    await hold("");
    assert.match(await text("readout"), /^Draft/, "after Stop the draft remains one");
    // The complete search.
    await page.locator("#to").fill("29");
    await page.locator("#to").press("Enter");
    await ready(page);
    assert.doesNotMatch(await text("readout"), /^Draft/);
    assert.ok((await page.locator("#bifurcations tr").count()) > 20);
    const { marks, curves } = await drawn(page);
    assert.ok(marks > 50 && marks < curves / 2, `${marks} pixels of marks, ${curves} of curves`);
    await own.close();
});

/** Pixels of the marks and of the curves in the response. */
const drawn = (page) => page.locator("#chart-response canvas").evaluate((canvas) => {
    const [box, over] = [canvas, document.querySelector("#chart-response .u-over")].map((own) => own.getBoundingClientRect());
    const ratio = canvas.width / box.width;
    const { data } = canvas.getContext("2d").getImageData((over.left - box.left) * ratio, (over.top - box.top) * ratio, over.width * ratio, over.height * ratio);
    const ink = getComputedStyle(document.body).color.match(/\d+/g).map(Number);
    let [marks, curves] = [0, 0];
    for (let k = 0; k < data.length; k += 4) {
        if (data[k + 3] < 200) continue;
        if (ink.every((own, part) => Math.abs(own - data[k + part]) < 12)) marks++;
        else if (Math.max(...data.slice(k, k + 3)) - Math.min(...data.slice(k, k + 3)) > 60) curves++;
    }
    return { marks, curves };
});

/** Waits until the search has ended. */
const rest = (page) => page.waitForFunction(() => /branch/.test(document.getElementById("chart-response").ariaLabel) && !document.querySelector("[aria-busy=true]"));

test("gap 5.2 mm: each attractor is named, or the caveat covers its period", async () => {
    const server = await serve();
    const page = await open(browser.context, server.address);
    for (const [key, value] of [["stop.tip.gap", "5.2"], ["drive.shaker.frequency", "12.55"]]) {
        const field = page.getByLabel(`${key}, value`, { exact: true });
        await field.fill(value);
        await field.press("Enter");
    }
    await page.waitForFunction(() => /^At 12\.55 Hz: .* of 100 starts/.test(document.getElementById("operating-words").textContent));
    await rest(page);
    const words = await page.locator("#operating-words").textContent();
    const periods = [...words.matchAll(/period (\d+), (?:stable|by)/g)].map(([, period]) => Number(period));
    for (const period of [5, 6]) assert.ok(periods.includes(period), words);
    const note = await page.locator("#note").textContent();
    const [, longest] = note.match(/branches of a period above (\d+) cycles\.$/) ?? assert.fail(note);
    // The branches of the attractor that most starts reach are searched for.
    assert.ok(Number(longest) >= periods[0], `${note} ${words}`);
    await page.locator("#long-periods").check();
    await page.waitForFunction(() => /branches of a period above 8 cycles\.$/.test(document.getElementById("note").textContent));
    await rest(page);
    assert.match(await page.locator("#note").textContent(), /^The search misses branches that none of \d+ seeds converges to, and branches of a period above 8 cycles\.$/, "period 12 exists");
    assert.deepEqual(page.faults, []);
    await page.close();
    await server.close();
});
