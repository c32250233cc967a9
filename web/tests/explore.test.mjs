// Exploration: zoom and pan, the cursor, changed values and the file, basins and their orbits.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { field, page, server, type, until } from "./suite.mjs";

const text = (id) => page.locator(`#${id}`).textContent();
/** Ends of the labels of the horizontal axis of the response. */
const visible = () => page.evaluate(() => {
    const chart = document.querySelector("#chart-response .u-over").getBoundingClientRect();
    return [chart.left, chart.right, chart.top, chart.bottom];
});
const isZoomed = () => page.locator("#zoom-out").isVisible();
/** Pixels of the response. */
const picture = () => page.locator("#chart-response canvas").evaluate((canvas) => canvas.toDataURL());

test("the wheel zooms, a drag pans, a double-click shows the complete range", async () => {
    const [left, right, top, bottom] = await visible();
    const [x, y] = [left + 0.3 * (right - left), top + 0.4 * (bottom - top)];
    const complete = await picture();
    assert.equal(await isZoomed(), false);
    await page.mouse.move(x, y);
    for (let k = 0; k < 4; k++) await page.mouse.wheel(0, -100);
    await page.locator("#zoom-out").waitFor({ state: "visible" });
    const zoomed = await picture();
    assert.notEqual(zoomed, complete);
    const orbit = await text("orbit-title");
    await page.mouse.down();
    await page.mouse.move(x + 60, y + 30, { steps: 4 });
    await page.mouse.up();
    assert.notEqual(await picture(), zoomed);
    assert.equal(await text("orbit-title"), orbit, "a drag selects nothing");
    await page.mouse.dblclick(right - 5, top + 5);
    await page.locator("#zoom-out").waitFor({ state: "hidden" });
});

test("the keys zoom and pan, and the visible part becomes the range", async () => {
    await page.locator("#chart-response").focus();
    for (let k = 0; k < 3; k++) await page.keyboard.press("+");
    assert.ok(await isZoomed());
    const before = await picture();
    await page.keyboard.press("Shift+ArrowRight");
    assert.notEqual(await picture(), before);
    await page.keyboard.press("0");
    assert.equal(await isZoomed(), false);
    for (let k = 0; k < 3; k++) await page.keyboard.press("+");
    await page.locator("#zoom-range").click();
    await ready(page);
    const [from, to] = [Number(await page.locator("#from").inputValue()), Number(await page.locator("#to").inputValue())];
    assert.ok(from > 12 && to < 14.3 && Math.abs((to - from) / (14.82 - 11.44) - 0.8 ** 3) < 0.01, `${from} ${to}`);
    assert.equal(await isZoomed(), false);
    for (const [id, value] of [["from", "11.44"], ["to", "14.82"]]) {
        await page.locator(`#${id}`).fill(value);
        await page.locator(`#${id}`).press("Enter");
    }
    await ready(page);
});

test("one cursor on the histories, the phase portrait and the motion", async () => {
    const box = await page.locator("#chart-voltage .u-over").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await until("orbit-cursor", /ms, .*m, .*m\/s, .*V, .*N/);
    const time = Number((await text("orbit-cursor")).match(/^([\d.]+) ms/)[1]);
    assert.ok(Math.abs(time - 500 / 13) < 1.5, String(time));
    const at = (id) => page.locator(`#${id} .cursor`).evaluate((own) => {
        const over = own.parentElement.getBoundingClientRect();
        return (own.getBoundingClientRect().left - over.left) / over.width;
    });
    for (const id of ["chart-voltage", "chart-displacement", "chart-force"]) assert.ok(Math.abs((await at(id)) - 0.5) < 0.02, id);
    assert.equal(await page.locator("#chart-phase .cursor.dot").count(), 1);
    assert.ok(Math.abs(Number(await page.locator("#phase").inputValue()) - time * 13) < 3);
    await page.mouse.move(5, 5);
    await page.waitForFunction((old) => document.getElementById("phase").value !== old, await page.locator("#phase").inputValue());
});

test("the response shows the amplitude at the stop, by the mouse and for screen readers", async () => {
    const power = await picture();
    await page.locator("#quantity").selectOption("displacement");
    const chart = page.locator("#chart-response");
    assert.match(await chart.getAttribute("aria-label"), /^Amplitude at the stop over/);
    assert.match(await chart.getAttribute("aria-valuetext"), /^13(\.\d+)? Hz, .*W, amplitude at the stop [\d.]+ mm, period 1/);
    assert.notEqual(await picture(), power);
    await page.locator("#quantity").selectOption("power");
    assert.doesNotMatch(await chart.getAttribute("aria-valuetext"), /Displacement/);
});

test("a changed value is marked and restored alone", async () => {
    const row = (key) => page.locator(`.control.changed:has([aria-label='${key}, value'])`);
    assert.equal(await page.locator(".control.changed").count(), 0);
    await type("stop.tip.gap", "0.8");
    await type("circuit.load.resistance", "2");
    await row("circuit.load.resistance").waitFor();
    await page.getByLabel("stop.tip.gap: restore the value of the file").click();
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "1");
    await row("stop.tip.gap").waitFor({ state: "detached" });
    assert.equal(await field("circuit.load.resistance").inputValue(), "2");
    await page.locator("#reset").click();
    await ready(page);
    assert.equal(await page.locator(".control.changed").count(), 0);
});

test("the page shows the lines of the file that change, and saves them", async () => {
    const before = await readFile(server.spec, "utf8");
    await type("stop.tip.gap", "0.8");
    await ready(page);
    await page.locator("#save").click();
    await page.locator("#save-dialog").waitFor({ state: "visible" });
    assert.equal(await text("save-difference"), '- gap = "1 mm"\n+ gap = "0.8 mm"');
    await page.locator("#save-write").click();
    await page.locator("#save-dialog").waitFor({ state: "hidden" });
    assert.equal(await readFile(server.spec, "utf8"), before.replace('gap = "1 mm"', 'gap = "0.8 mm"'));
    await page.locator(".control.changed").first().waitFor({ state: "detached" });
    assert.equal(await field("stop.tip.gap").inputValue(), "0.8");
    await ready(page);
    await page.locator("#save").click();
    await page.locator("#save-dialog").waitFor({ state: "visible" });
    assert.match(await text("save-difference"), /those of the file/);
    assert.ok(await page.locator("#save-write").isDisabled());
    await page.keyboard.press("Escape");
    // The step back is the value of the file as it now is, so the file is set back as an editor does it.
    await type("stop.tip.gap", "1");
    await ready(page);
    await page.locator("#save").click();
    await page.locator("#save-write").click();
    await page.locator("#save-dialog").waitFor({ state: "hidden" });
    assert.equal(await readFile(server.spec, "utf8"), before);
    await ready(page);
});

test("a click on the basins shows the orbit of the attractor there", async () => {
    await type("drive.shaker.frequency", "12.55");
    await ready(page);
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-run").click();
    await until("basins-words", /expected power/);
    const box = await page.locator("#chart-basins .u-over").boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await until("basins-note", /The orbit of \w+ is shown/);
    const name = (await text("basins-note")).match(/of (\w+) is/)[1];
    const power = (await page.locator("#attractors li").filter({ hasText: `${name}:` }).textContent()).match(/, ([\d.]+ .?W)$/)[1];
    await until("orbit-title", new RegExp(`Orbit at 12\\.55 Hz: ${power.split(" ")[0].slice(0, 4)}`));
    await page.locator("#attractors button").last().click();
    await until("basins-note", /The orbit of \w+ is shown|No branch/);
    await type("stop.tip.gap", "1.1");
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await until("basins-note", /of an earlier design/);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
