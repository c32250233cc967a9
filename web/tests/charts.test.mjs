// Letters of the charts: on every tab and at every width of the page, none is cut and no two cover each other.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ready, serve } from "./browser.mjs";
import { browser, page, until } from "./suite.mjs";

/** Records the texts of each canvas with their boxes, in its pixels. */
const record = () => page.evaluate(() => {
    window.letters = new Map();
    const own = CanvasRenderingContext2D.prototype;
    const { fillText, clearRect } = own;
    own.clearRect = function (...box) {
        window.letters.set(this.canvas, []);
        return clearRect.apply(this, box);
    };
    own.fillText = function (words, x, y) {
        const { actualBoundingBoxLeft, actualBoundingBoxRight, actualBoundingBoxAscent, actualBoundingBoxDescent } = this.measureText(words);
        const matrix = this.getTransform();
        const corners = [[x - actualBoundingBoxLeft, y - actualBoundingBoxAscent], [x + actualBoundingBoxRight, y + actualBoundingBoxDescent]].map(([left, top]) => matrix.transformPoint({ x: left, y: top }));
        const ends = (side) => [Math.min(...corners.map((corner) => corner[side])), Math.max(...corners.map((corner) => corner[side]))];
        if (words !== "") window.letters.get(this.canvas)?.push({ words, x: ends("x"), y: ends("y") });
        return fillText.call(this, words, x, y);
    };
});

/** Letters of visible charts that are cut or cover each other. */
const badLetters = () => page.evaluate(() => [...window.letters].flatMap(([canvas, letters]) => {
    if (!canvas.checkVisibility() || !canvas.closest(".chart")) return [];
    const host = canvas.closest(".chart").id;
    const cut = letters.filter(({ x, y }) => x[0] < 0 || y[0] < 0 || x[1] > canvas.width || y[1] > canvas.height);
    const covers = (a, b) => ["x", "y"].every((side) => Math.min(a[side][1], b[side][1]) - Math.max(a[side][0], b[side][0]) > 0);
    const pairs = letters.flatMap((a, k) => letters.slice(k + 1).filter((b) => covers(a, b)).map((b) => `${host}: ${a.words} / ${b.words}`));
    return [...cut.map(({ words }) => `${host}: cut ${words}`), ...pairs];
}));

test("no letters of a chart are cut or cover each other", async () => {
    await record();
    await page.locator("#tab-load").click();
    await until("load-words", /largest power/);
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-run").click();
    await until("basins-words", /expected power/);
    await page.locator("#tab-shake").click();
    await page.locator("#shake-spec").click();
    await until("shake-words", /on average over/);
    const bad = [];
    for (const [width, height] of [[390, 844], [820, 1180], [1280, 560], [1280, 800], [2560, 1440]]) {
        await page.setViewportSize({ width, height });
        for (const tab of ["response", "load", "basins", "shake"]) {
            await page.locator(`#tab-${tab}`).click();
            await page.waitForTimeout(300);
            bad.push(...(await badLetters()).map((words) => `${width} x ${height}, ${words}`));
        }
    }
    assert.deepEqual(bad, []);
});

/** Height of the chart of the response in a window of 1280 x 800, CSS pixels, with all text below it visible. */
const chartHeight = async (own) => {
    await own.setViewportSize({ width: 1280, height: 800 });
    await own.locator("#tab-response").click();
    // A drawing for the new room replaces the old one after a rest.
    await own.waitForTimeout(1000);
    await ready(own);
    const text = await own.locator("#panel-response").evaluate((panel) => [panel.scrollHeight - panel.clientHeight, ...[...panel.querySelectorAll(".readout")].map((one) => one.scrollHeight - one.clientHeight)]);
    assert.ok(text.every((hidden) => hidden <= 1), `hidden: ${text}`);
    return (await own.locator("#chart-response").boundingBox()).height;
};

test("at 1280 x 800 the response has more height than the drawing, and all text below it is visible", async () => {
    const chart = await chartHeight(page);
    const { height } = await page.locator("#drawing").boundingBox();
    assert.ok(chart > 220 && chart > height, `${chart} of the chart, ${height} of the drawing`);
});

test("at 1280 x 800 several circuits and close-ups stand in one row, so that the drawing leaves the response its height", async () => {
    const beams = await serve({ kind: "two-beams" });
    const own = await browser.context.newPage();
    await own.setViewportSize({ width: 1280, height: 800 });
    await own.goto(beams.address);
    await own.locator("#close > svg").nth(2).waitFor();
    const tops = await own.locator("#close > svg").evaluateAll((views) => views.map((view) => Math.round(view.getBoundingClientRect().top)));
    assert.equal(new Set(tops).size, 1, String(tops));
    const { height } = await own.locator("#drawing").boundingBox();
    assert.ok(height < 200, `${height}`);
    await own.close();
    await beams.close();
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
