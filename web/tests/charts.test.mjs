// Letters of the charts: on every tab and at every width of the page, none is cut and no two cover each other.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { page, until } from "./suite.mjs";

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

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
