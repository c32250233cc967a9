// Labels and boxes on the charts, the drawing on a narrow page, and pictures.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { badLabels, page, server, type } from "./suite.mjs";

/** Records texts with their boxes, segments of curves and rings that are drawn on the response, in device pixels. */
const record = () => page.evaluate(() => {
    window.drawn = { texts: [], lines: [], rings: [] };
    const own = CanvasRenderingContext2D.prototype;
    const { fillText, moveTo, lineTo, stroke, beginPath, arc, clearRect } = own;
    const isResponse = (ctx) => ctx.canvas.closest("#chart-response");
    let path = [];
    own.clearRect = function (...box) {
        if (isResponse(this)) window.drawn = { texts: [], lines: [], rings: [] };
        return clearRect.apply(this, box);
    };
    own.beginPath = function () {
        path = [];
        return beginPath.call(this);
    };
    own.moveTo = function (x, y) {
        path.push([undefined, [x, y]]);
        return moveTo.call(this, x, y);
    };
    own.lineTo = function (x, y) {
        path.push([path.at(-1)?.[1], [x, y]]);
        return lineTo.call(this, x, y);
    };
    own.arc = function (x, y, r, ...rest) {
        if (isResponse(this)) window.drawn.rings.push([x, y, r]);
        return arc.call(this, x, y, r, ...rest);
    };
    own.stroke = function () {
        if (isResponse(this) && this.lineWidth === 2) window.drawn.lines.push(...path.filter(([from]) => from));
        return stroke.call(this);
    };
    own.fillText = function (words, x, y) {
        if (isResponse(this) && this.getTransform().b === 0) {
            const { width, actualBoundingBoxAscent: up, actualBoundingBoxDescent: down } = this.measureText(words);
            const left = x - { right: 1, end: 1, center: 0.5 }[this.textAlign] * width || x;
            window.drawn.texts.push({ words, box: [left, y - up, left + width, y + down], align: this.textAlign });
        }
        return fillText.call(this, words, x, y);
    };
});
const drawn = () => page.evaluate(() => window.drawn);
const inside = ([x, y], [left, top, right, low]) => x > left && x < right && y > top && y < low;
const along = ([[a, b], [c, d]]) => Array.from({ length: 200 }, (_, k) => [a + ((c - a) * k) / 199, b + ((d - b) * k) / 199]);

test("a logarithmic axis has at least two labels", async () => {
    await record();
    for (const [low, high] of [[2.1e-5, 9.5e-5], [5.5e-5, 2.4e-4], [3e-6, 9e-4], [2e-5, 1.9e-4]]) {
        await page.evaluate((zoom) => (location.hash = `#over=drive.shaker.frequency&from=11&to=14&zoom=${zoom}`), [12, 13.5, low, high].join(":"));
        await page.locator("#zoom-out").waitFor({ state: "visible" });
        await ready(page);
        for (const height of [420, 800]) {
            await page.setViewportSize({ width: 1280, height });
            await page.waitForTimeout(300);
            const { texts } = await drawn();
            const numbers = texts.filter(({ words, align }) => /^[\d.e-]+$/.test(words) && align === "right");
            assert.ok(numbers.length >= 2, `${low} to ${high} at ${height} px: ${JSON.stringify(texts.map(({ words }) => words))}`);
        }
        await page.locator("#zoom-out").click();
    }
    await page.setViewportSize({ width: 1280, height: 800 });
});

test("the label of a limit does not lie across a curve", async () => {
    await page.locator("#groups details").evaluateAll((list) => list.forEach((group) => (group.open = true)));
    await page.locator("#quantity").selectOption("strain");
    for (const ppm of ["15", "50", "120", "300", "600"]) {
        await type("patch.mfc.strain_limit", `${ppm} ppm`);
        await page.waitForFunction((words) => window.drawn.texts.some((own) => own.words === words), `limit ${ppm} ppm`);
        await ready(page);
        await page.waitForFunction(() => !/Computing the strain/.test(document.getElementById("readout").textContent));
        const { texts, lines } = await drawn();
        const label = texts.find(({ words }) => words === `limit ${ppm} ppm`);
        assert.ok(lines.length > 50);
        // The limit is on the axis, also where the strain is far from it.
        const height = await page.locator("#chart-response canvas").evaluate((canvas) => canvas.height);
        assert.ok(label.box[1] > 0 && label.box[3] < height, `${ppm} ppm: ${label.box} of ${height}`);
        assert.ok(!lines.some((line) => along(line).some((at) => inside(at, label.box))), `${ppm} ppm`);
    }
    await page.locator("#reset").click();
    await page.locator("#quantity").selectOption("power");
    await ready(page);
});

test("the readout of a point does not cover it", async () => {
    for (const width of [1280, 390]) {
        await page.setViewportSize({ width, height: 844 });
        await page.waitForTimeout(300);
        const [box, frame] = [await page.locator("#chart-response .u-over").boundingBox(), await page.locator("#chart-response").boundingBox()];
        let shown = 0;
        for (let k = 0; k < 60; k++) {
            await page.mouse.move(box.x + box.width * ((k * 0.618) % 1), box.y + box.height * ((k * 0.37) % 1));
            const readout = await page.locator("#response-cursor").boundingBox();
            if (!readout) continue;
            const ratio = await page.evaluate(() => devicePixelRatio);
            const ring = (await drawn()).rings.find(([, , r]) => r === 5 * ratio);
            const at = [ring[0] / ratio + frame.x, ring[1] / ratio + frame.y];
            assert.ok(!inside(at, [readout.x - 4, readout.y - 4, readout.x + readout.width + 4, readout.y + readout.height + 4]), `${at} in ${JSON.stringify(readout)}`);
            assert.ok(readout.x >= frame.x - 1 && readout.x + readout.width <= frame.x + frame.width + 1 && readout.y >= frame.y - 1 && readout.y + readout.height <= frame.y + frame.height + 1);
            shown++;
        }
        assert.ok(shown > 10, String(shown));
    }
    await page.setViewportSize({ width: 1280, height: 800 });
});

test("at 390 px the side view is complete without scrolling, and its labels can be read", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await page.waitForFunction(() => document.querySelector("#side > svg").viewBox.baseVal.width < 420);
    const views = await page.locator("#side").evaluate((host) => [host.scrollWidth, host.clientWidth, ...[...host.children].map((view) => view.getBoundingClientRect().right - host.getBoundingClientRect().right)]);
    assert.ok(views[0] <= views[1] && views.slice(2).every((beyond) => beyond <= 1), String(views));
    for (const [key, value] of [["patch.mfc.length", "300"], ["beam.beam.point.tip", "100"], ["stop.tip.gap", "40"], ["stop.tip.gap", "1"]]) {
        await type(key, value);
        await page.waitForFunction(() => document.getElementById("drawing").ariaBusy === "false");
        assert.deepEqual(await badLabels(page), [], `${key} ${value}`);
        const smallest = await page.locator("#drawing svg text").evaluateAll((texts) => Math.min(...texts.map((own) => own.getBoundingClientRect().height)));
        assert.ok(smallest >= 10, String(smallest));
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.waitForFunction(() => document.querySelector("#side > svg").viewBox.baseVal.width > 500);
    await page.locator("#reset").click();
    await ready(page);
});

test("a picture has the chosen size, and a legend below the chart", async () => {
    const sizes = [];
    for (const factor of ["1", "2", "4"]) {
        await page.locator("#export").click();
        await page.locator("#export-size").selectOption(factor);
        const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#export-picture").click()]);
        const path = `${server.folder}/picture-${factor}.png`;
        await download.saveAs(path);
        const png = await readFile(path);
        sizes.push([png.readUInt32BE(16), png.readUInt32BE(20)]);
        await page.keyboard.press("Escape");
        if (factor !== "2") continue;
        // The chart of the picture is that of the page, and below it something is drawn.
        const found = await page.evaluate(async (bytes) => {
            const image = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: "image/png" }));
            const canvas = new OffscreenCanvas(image.width, image.height);
            const ctx = canvas.getContext("2d");
            ctx.drawImage(image, 0, 0);
            const chart = document.querySelector("#chart-response canvas");
            const paper = ctx.getImageData(0, 0, 1, 1).data;
            const inked = (top, height) => {
                const { data } = ctx.getImageData(0, top, image.width, height);
                let count = 0;
                for (let k = 0; k < data.length; k += 4) if (Math.abs(data[k] - paper[0]) + Math.abs(data[k + 1] - paper[1]) > 60) count++;
                return count;
            };
            return [inked(0, 2 * chart.height), inked(2 * chart.height, image.height - 2 * chart.height), chart.width, chart.height];
        }, [...png]);
        assert.ok(found[0] > 5000 && found[1] > 500, String(found));
        assert.deepEqual([sizes[1][0], sizes[1][1] > 2 * found[3]], [2 * found[2], true]);
    }
    assert.deepEqual([sizes[1][0], sizes[2][0]], [2 * sizes[0][0], 4 * sizes[0][0]]);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
