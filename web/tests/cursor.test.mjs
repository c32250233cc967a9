// Pointing: the response, the charts of the orbit, its phase portrait and its motion show one point and one instant.
import assert from "node:assert/strict";
import { test } from "node:test";
import { ready } from "./browser.mjs";
import { page, until } from "./suite.mjs";

const text = (id) => page.locator(`#${id}`).textContent();
const over = (id) => page.locator(`#${id} .u-over`).boundingBox();
const phase = () => page.locator("#phase").inputValue().then((own) => Number(own) / 1000);
/** Share of the width or height of a chart at which a cursor stands. */
const cursorAt = (id, index = 0) => page.locator(`#${id}`).evaluate((host, k) => {
    const box = host.querySelector(".u-over").getBoundingClientRect();
    const own = host.querySelectorAll(".cursor")[k].getBoundingClientRect();
    return [(own.left + own.right) / 2 - box.left, (own.top + own.bottom) / 2 - box.top, box.width, box.height];
}, index);
/** Row of the highest pixel of the curve in a column of the response, CSS pixels from above; `red`, `green`, `blue` of its colour. */
const rowOfCurve = (x, colour) => page.locator("#chart-response canvas").evaluate((canvas, [at, wanted]) => {
    const ratio = canvas.width / canvas.getBoundingClientRect().width;
    const { data } = canvas.getContext("2d").getImageData(Math.round(at * ratio), 0, 1, canvas.height);
    for (let k = 0; k < canvas.height; k++) if ([0, 1, 2].every((part) => Math.abs(data[4 * k + part] - wanted[part]) < 12)) return k / ratio;
    return undefined;
}, [x, colour]);
const BLUE = [0, 114, 178];

test("the pointer over the response reads the nearest point of the curve, also between points that are far apart", async () => {
    const box = await over("chart-response");
    const canvas = await page.locator("#chart-response canvas").boundingBox();
    const onCurve = async (share) => {
        const x = box.x + share * box.width;
        const row = await rowOfCurve(x - canvas.x, BLUE);
        if (row !== undefined) await page.mouse.move(x, canvas.y + row);
        return row !== undefined;
    };
    // Far into a smooth part, where the points of the curve are further apart than the pointer reaches.
    for (let round = 0; round < 4; round++) {
        assert.ok(await onCurve(0.3));
        for (let k = 0; k < 5; k++) await page.mouse.wheel(0, -100);
        await page.waitForTimeout(200);
    }
    const words = new Set();
    for (let k = 0; k <= 20; k++) {
        if (await onCurve(0.02 + 0.048 * k)) words.add(await text("response-cursor"));
    }
    await page.locator("#zoom-out").click();
    assert.ok(words.size > 0 && !words.has(""), [...words].join(" | "));
    for (const own of words) assert.match(own, /Hz, .*W, period 1, stable, \d+ contacts?$/);
});

test("the readout stands beside the pointer, inside the chart, and covers no point that it reads", async () => {
    for (const width of [1280, 390]) {
        await page.setViewportSize({ width, height: 844 });
        await ready(page);
        await page.locator("#chart-response").scrollIntoViewIfNeeded();
        const [box, canvas] = [await over("chart-response"), await page.locator("#chart-response canvas").boundingBox()];
        for (const share of [0.05, 0.3, 0.7, 0.95]) {
            const x = box.x + share * box.width;
            const y = canvas.y + (await rowOfCurve(x - canvas.x, BLUE));
            await page.mouse.move(x, y);
            const own = await page.locator("#response-cursor").boundingBox();
            const host = await page.locator("#chart-response").boundingBox();
            assert.ok(own.x >= host.x && own.x + own.width <= host.x + host.width + 0.5 && own.y >= host.y && own.y + own.height <= host.y + host.height, JSON.stringify([width, share, own]));
            assert.ok(y < own.y - 5 || y > own.y + own.height + 5, JSON.stringify([width, share, own, y]));
        }
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await ready(page);
});

test("a drag along a curve shows the orbit of each point that it passes", async () => {
    const box = await over("chart-response");
    const canvas = await page.locator("#chart-response canvas").boundingBox();
    const at = async (share) => {
        const x = box.x + share * box.width;
        return [x, canvas.y + (await rowOfCurve(x - canvas.x, BLUE))];
    };
    const [from, to] = [await at(0.2), await at(0.28)];
    await page.mouse.move(...from);
    await page.mouse.down();
    const titles = new Set();
    for (let k = 1; k <= 8; k++) {
        await page.mouse.move(from[0] + ((to[0] - from[0]) * k) / 8, from[1] + ((to[1] - from[1]) * k) / 8);
        await ready(page);
        titles.add(await text("orbit-title"));
    }
    await page.mouse.up();
    assert.ok(titles.size > 2, [...titles].join(" | "));
    const [hertz, watt] = (await text("response-cursor")).split(", ");
    await until("orbit-title", new RegExp(`^Orbit at ${hertz.replace(".", "\\.")}: `));
    // The click that ends a drag selects nothing else.
    assert.equal((await text("orbit-title")).split(": ")[1].split(", ")[0].slice(0, 4), watt.slice(0, 4));
});

test("a history, the phase portrait and the motion show the instant that is pointed at in any of them", async () => {
    const histories = ["chart-displacement", "chart-voltage", "chart-force"];
    const agree = async (due) => {
        const shown = await phase();
        assert.ok(Math.abs(shown - due) < 0.01, `${shown} ${due}`);
        for (const id of histories) {
            const [x, , width] = await cursorAt(id);
            assert.ok(Math.abs(x / width - due) < 0.01, `${id} ${x / width} ${due}`);
        }
    };
    // Large enough for a pixel of the portrait to be less than the tolerance.
    await page.setViewportSize({ width: 1920, height: 1080 });
    await page.waitForTimeout(300);
    for (const share of [0.1, 0.37, 0.83]) {
        const box = await over("chart-voltage");
        await page.mouse.move(box.x + share * box.width, box.y + 0.4 * box.height);
        await agree(share);
        // The point of the phase portrait at this instant leads back to the instant.
        const [x, y] = await cursorAt("chart-phase");
        const portrait = await over("chart-phase");
        await page.mouse.move(portrait.x + x, portrait.y + y);
        await agree(share);
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.waitForTimeout(300);
});

test("pointing at the beam shows an instant at which it passes there", async () => {
    const box = await page.locator("#motion").boundingBox();
    const charts = await over("chart-displacement");
    /** Colours in a column of the motion: the rows of the beam. */
    const beamRow = (x) => page.locator("#motion").evaluate((canvas, at) => {
        const ratio = canvas.width / canvas.getBoundingClientRect().width;
        const wanted = getComputedStyle(document.documentElement).getPropertyValue("--beam").trim();
        const [r, g, b] = [1, 3, 5].map((k) => parseInt(wanted.slice(k, k + 2), 16));
        const { data } = canvas.getContext("2d").getImageData(Math.round(at * ratio), 0, 1, canvas.height);
        const rows = [];
        for (let k = 0; k < canvas.height; k++) if (data[4 * k] === r && data[4 * k + 1] === g && data[4 * k + 2] === b) rows.push(k / ratio);
        return rows.length > 0 ? (rows[0] + rows.at(-1)) / 2 : undefined;
    }, x);
    const x = 0.8 * box.width;
    let seen = 0;
    for (const share of [0.05, 0.2, 0.45, 0.6, 0.9]) {
        await page.mouse.move(charts.x + share * charts.width, charts.y + 10);
        const row = await beamRow(x);
        if (row === undefined) continue;
        seen++;
        await page.mouse.move(box.x + x, box.y + row);
        const shown = await phase();
        assert.ok(Math.abs(shown - share) < 0.02, `${shown} ${share}`);
        assert.ok(Math.abs((await cursorAt("chart-displacement"))[0] / charts.width - shown) < 0.01);
    }
    assert.ok(seen >= 3, String(seen));
});

test("the force under the cursor is that of the chart, also in a contact that is shorter than a sample", async () => {
    const newton = (words) => {
        const [, number, prefix] = words.match(/ (-?[\d.]+) (m|k|)N$/);
        return Number(number) * { m: 1e-3, k: 1e3, "": 1 }[prefix];
    };
    const largest = newton(await page.locator("#chart-force").getAttribute("aria-label"));
    const box = await over("chart-force");
    let most = 0;
    for (let x = 0; x <= box.width; x += 0.5) {
        await page.mouse.move(box.x + x, box.y + 5);
        most = Math.max(most, newton(await text("orbit-cursor")));
    }
    assert.ok(largest > 0 && most > 0.7 * largest && most <= 1.001 * largest, `${most} ${largest}`);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
