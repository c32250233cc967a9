// A plate on the page: its plan view, its mode shapes and its motion as contours, and no beam.
import assert from "node:assert/strict";
import { test, after, before } from "node:test";
import { browse, inked, open, ready, serve } from "./browser.mjs";

let server;
let browser;
let page;
before(async () => {
    server = await serve({ example: "plate-de-marqui-2009/stop.toml" });
    browser = await browse();
    page = await open(browser.context, server.address);
});
after(async () => {
    await browser?.close();
    await server?.close();
});

const box = (selector) => page.locator(selector).first().boundingBox();

test("the plan view shows the plate to scale, its patch, its clamped edge and the point that strikes", async () => {
    const plan = page.getByLabel("Plan view of a plate, to scale");
    assert.equal(await plan.count(), 1);
    const text = await plan.textContent();
    for (const words of ["plate, seen from above", "100 × 60 × 0.5 mm", "ceramic", "corner: stop corner"]) assert.match(text, new RegExp(words));
    // 100 mm by 60 mm, and a patch of 50 mm by 50 mm.
    const [plate, patch] = await plan.locator("rect:not(.jounce-paper)").evaluateAll((all) => all.map((one) => one.getBoundingClientRect()).map(({ x, y, width, height }) => ({ x, y, width, height })));
    assert.ok(plate.width > 60 && Math.abs(plate.height / plate.width - 0.6) < 0.01, JSON.stringify(plate));
    assert.ok(Math.abs(patch.width / plate.width - 0.5) < 0.01 && Math.abs(patch.height / patch.width - 1) < 0.01, JSON.stringify(patch));
    const visible = await box("#side .plan");
    assert.ok(plate.x >= visible.x && plate.y + plate.height <= visible.y + visible.height, "the plate lies in its view");
    assert.equal(await page.locator("#side .jounce-beam, #close .jounce-beam").count(), 0);
});

test("the plan view follows the design", async () => {
    await page.getByLabel("plate.plate.width, value", { exact: true }).evaluate((field) => field.closest("details")?.setAttribute("open", ""));
    await page.getByLabel("plate.plate.width, value", { exact: true }).fill("70 mm");
    await page.getByLabel("plate.plate.width, value", { exact: true }).press("Enter");
    await page.waitForFunction(() => /100 × 70 ×/.test(document.getElementById("side").textContent));
    await page.locator("#reset").click();
    await ready(page);
});

test("the orbit shows the motion of the plate as contours, and no beam", async () => {
    assert.ok(await page.locator("#motion").isHidden());
    assert.match(await page.locator("#plate-motion figcaption").textContent(), /^plate: displacement from -[\d.]+ .m \(dark\) to [\d.]+ .m \(light\)$/);
    const colours = () => page.locator("#plate-motion path").evaluateAll((all) => all.map((one) => one.getAttribute("fill")).filter((fill) => fill?.startsWith("#")));
    const at = async (phase) => {
        await page.locator("#phase").fill(String(phase));
        return colours();
    };
    const drawn = [];
    for (const phase of [0, 250, 500, 750]) drawn.push(await at(phase));
    assert.ok(drawn.every((own) => own.length > 0) && new Set(drawn.flat()).size > 12, JSON.stringify(drawn));
});

test("the modes are contours with nodal lines, and follow the design", async () => {
    await page.locator("#tab-modes").click();
    const figure = page.locator("#mode-figures .figure");
    await figure.waitFor();
    const frequencies = async () => (await figure.textContent()).match(/\d: [\d.]+ Hz/g).map((text) => Number(text.slice(3, -3)));
    const before = await frequencies();
    assert.equal(before.length, 5);
    const fills = new Set(await figure.locator("path[fill^='#']").evaluateAll((all) => all.map((one) => one.getAttribute("fill"))));
    assert.ok(fills.size >= 24, `${fills.size} colours`);
    const { width } = await figure.boundingBox();
    assert.ok(width > 300 && width <= (await box("#mode-figures")).width, `${width}`);
    await page.getByLabel("plate.plate.thickness, value", { exact: true }).fill("0.6 mm");
    await page.getByLabel("plate.plate.thickness, value", { exact: true }).press("Enter");
    await page.waitForFunction((old) => {
        const now = document.querySelector("#mode-figures .figure").textContent.match(/1: ([\d.]+) Hz/)?.[1];
        return now !== undefined && Number(now) > old && !document.querySelector("[aria-busy=true]");
    }, before[0]);
    await page.locator("#reset").click();
    await page.locator("#tab-response").click();
    await ready(page);
});

test("a narrow page shows the plan and nothing leaves it", async () => {
    await page.setViewportSize({ width: 390, height: 800 });
    // The server draws a narrower sheet.
    await page.waitForFunction(() => document.querySelector("#side .plan")?.getBoundingClientRect().right <= 390);
    // A new sheet replaces the plan at any time: one step reads both.
    const [plan, wide] = await page.evaluate(() => [document.querySelector("#side .plan").getBoundingClientRect().toJSON(), document.documentElement.scrollWidth]);
    assert.ok(plan.width > 200 && plan.x >= 0 && plan.x + plan.width <= 390 && wide <= 390, `${JSON.stringify(plan)} ${wide}`);
    await page.setViewportSize({ width: 1280, height: 800 });
});

/** Size of the smallest letters of the drawings and of the plates in motion, px, and the largest part of a drawing outside its panel. */
const readable = (own) => own.evaluate(() => {
    const shown = [...document.querySelectorAll("#drawing text, #plate-motion text")].filter((text) => text.checkVisibility());
    const panel = document.getElementById("drawing").getBoundingClientRect();
    const views = [...document.querySelectorAll("#drawing > div > svg")].map((view) => view.getBoundingClientRect());
    return {
        letters: Math.min(...shown.map((text) => parseFloat(getComputedStyle(text).fontSize) * Math.hypot(text.getScreenCTM().a, text.getScreenCTM().b))),
        outside: Math.max(...views.flatMap(({ left, right, top, bottom }) => [panel.left - left, right - panel.right, panel.top - top, bottom - panel.bottom])),
        count: shown.length,
    };
});

test("letters have at least 10 px, and no drawing is cut, at all widths of the window", async () => {
    for (const kind of ["plate", "two-beams"]) {
        const other = kind === "plate" ? undefined : await serve({ kind });
        const own = other ? await open(browser.context, other.address) : page;
        for (const width of [1920, 1280, 1101, 1000, 701, 700, 500, 390, 320]) {
            await own.setViewportSize({ width, height: 800 });
            // A sheet for the new room replaces the old one after a rest.
            await own.waitForTimeout(1500);
            await ready(own);
            const { letters, outside, count } = await readable(own);
            assert.ok(letters >= 9.99 && outside <= 1 && count > 8, `${kind}, ${width}: ${letters} px, ${outside} outside, ${count} labels`);
        }
        await own.setViewportSize({ width: 1280, height: 800 });
        if (other) await own.close();
        await other?.close();
    }
});

test("a beam has its motion on the canvas and its mode shapes as curves", async () => {
    const other = await serve();
    const beam = await open(browser.context, other.address);
    assert.ok((await inked(beam, "#motion")) > 0.01);
    assert.ok(await beam.locator("#plate-motion").isHidden());
    await beam.locator("#tab-modes").click();
    await beam.locator("#mode-figures .figure").waitFor();
    assert.match(await beam.locator("#mode-figures").textContent(), /Mode shapes of beam/);
    assert.deepEqual(beam.faults, []);
    await beam.close();
    await other.close();
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
