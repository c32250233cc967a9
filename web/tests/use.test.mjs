// Use of the page: fields and sliders, links, pins, narrow windows, specs of other kinds, a lost server.
import assert from "node:assert/strict";
import { test } from "node:test";
import { readFile } from "node:fs/promises";
import { inked, open, ready, serve } from "./browser.mjs";
import { badLabels, browser, field, page, server, type, until } from "./suite.mjs";

const reset = async () => {
    if (await page.locator("#reset").isEnabled()) await page.locator("#reset").click();
    await ready(page);
};

test("zero keeps the unit of the file", async () => {
    await type("stop.tip.gap", "0");
    await page.waitForFunction(() => location.hash.includes("0+mm"));
    await ready(page);
    const row = page.locator(".control:has(#control-stop-tip-gap)");
    assert.equal(await row.locator(".unit").textContent(), "mm");
    await type("stop.tip.gap", "2");
    await page.waitForFunction(() => /gap 2 mm/.test(document.getElementById("close").textContent));
    await reset();
});

test("a slider with a default keeps its drag", async () => {
    const phase = page.locator("#groups input[type=range][aria-label='drive.shaker.phase']");
    await page.locator("#groups details.more:has(input[aria-label='drive.shaker.phase']) > summary").click();
    await phase.evaluate((element) => (window.heldSlider = element));
    await phase.focus();
    for (let k = 0; k < 5; k++) {
        await page.keyboard.press("ArrowRight");
        await page.waitForTimeout(100);
    }
    await ready(page);
    assert.ok(await phase.evaluate((element) => element === window.heldSlider && document.activeElement === element));
    await reset();
});

test("points and patches stay on their beam", async () => {
    const slider = page.locator("input[type=range][aria-label='beam.beam.point.tip']");
    await page.locator("#groups > details:has(input[aria-label='beam.beam.point.tip']) > summary").click();
    await slider.focus();
    await page.keyboard.press("End");
    await ready(page);
    assert.equal(Number(await field("beam.beam.point.tip").inputValue()), 315);
    await ready(page);
    // The end of the patch is dragged far beyond the beam, then the tip.
    for (const [key, value, end] of [["patch.mfc.length", "patch.mfc.length", 306], ["beam.beam.point.tip", "beam.beam.point.tip", 315]]) {
        const box = await page.locator(`[data-handle="${key}"]`).first().boundingBox();
        const y = box.y + box.height / 2;
        await page.mouse.move(box.x + box.width / 2, y);
        await page.mouse.down();
        await page.mouse.move(box.x + 900, y, { steps: 4 });
        await page.mouse.up();
        await ready(page);
        assert.ok(Number(await field(value).inputValue()) <= end, `${key} ${await field(value).inputValue()}`);
    }
    assert.equal(await page.locator(".fault:visible").count(), 0);
    await reset();
});

test("a link with an unknown key shows the rest of it, and one in an open tab is followed", async () => {
    const other = await browser.context.newPage();
    await other.goto(`${server.address}#set=stop.tip.gap%3D0.7+mm&set=stop.tip.nonsense%3D3`);
    await ready(other);
    assert.equal(await other.getByLabel("stop.tip.gap, value", { exact: true }).inputValue(), "0.7");
    assert.match(await other.locator("#faults").textContent(), /nonsense/);
    await other.evaluate(() => (location.hash = "set=stop.tip.gap%3D0.6+mm"));
    await other.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "0.6");
    await other.locator("#undo").click();
    await other.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "0.7");
    await other.goto("about:blank");
    await other.goto(server.address.replace(/\/$/, ""));
    await ready(other);
    await other.close();
});

test("a link of a view alone, of an unknown axis, of a refused value, and of a reversed range", async () => {
    const other = await browser.context.newPage();
    const shows = async (id, value) => assert.equal(await other.locator(id).inputValue(), value);
    const follow = (hash) => other.evaluate((own) => (location.hash = own), hash);
    await other.goto(`${server.address}#over=drive.shaker.frequency&from=12&to=14`);
    await ready(other);
    await shows("#from", "12");
    // In the open page: the range of the link, and the values of the file.
    await follow("set=stop.tip.gap%3D0.7+mm");
    await other.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "0.7");
    await follow("over=stop.tip.gap&from=0.0005&to=0.0015");
    await other.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "1" && document.getElementById("over").value === "stop.tip.gap");
    await ready(other);
    await shows("#to", "1.5");
    assert.equal(await other.locator("#faults").textContent(), "");
    await follow("over=stop.nonsense.gap&from=1&to=2");
    await until("faults", /no number stop\.nonsense\.gap/, other);
    await ready(other);
    await shows("#over", "drive.shaker.frequency");
    await follow("over=drive.shaker.frequency&from=14&to=12&set=stop.tip.gap%3D0.8+mm");
    await other.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "0.8");
    await ready(other);
    await other.goto("about:blank");
    await other.goto(`${server.address}#over=stop.nonsense.gap&from=1&to=2&set=stop.tip.gap%3D-3+kg`);
    await ready(other);
    await shows("#over", "drive.shaker.frequency");
    assert.match(await other.locator("#groups .fault:visible, #faults").allTextContents().then((own) => own.join(" ")), /kg/);
    await other.close();
});

test("a page whose storage the browser refuses, as in a frame of another site, works and pins", async () => {
    const other = await browser.context.newPage();
    await other.addInitScript(() => {
        const refuse = () => { throw new DOMException("refused", "SecurityError"); };
        for (const name of ["localStorage", "sessionStorage"]) Object.defineProperty(window, name, { get: refuse });
    });
    await other.goto(server.address);
    await ready(other);
    await other.locator("#theme").click();
    await other.locator("#pin").click();
    await other.locator("#pins li").waitFor();
    await other.close();
});

test("pins: undo goes back over a restored one, the fifth is refused, and they outlive a reload with the theme", async () => {
    await page.locator("#pin").click();
    await type("stop.tip.gap", "0.9");
    await ready(page);
    await page.locator("#pins button").first().click();
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "1");
    await page.locator("#undo").click();
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "0.9");
    await page.locator("h1").click();
    await page.keyboard.press("Control+z");
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "1");
    await page.keyboard.press("Control+y");
    await page.waitForFunction(() => document.querySelector("[aria-label='stop.tip.gap, value']").value === "0.9");
    for (let k = 0; k < 4; k++) await page.locator("#pin").click();
    assert.equal(await page.locator("#pins li").count(), 4);
    await until("reply", /at most 4 pins/);
    const theme = await page.evaluate(() => document.documentElement.dataset.theme);
    await page.locator("#theme").click();
    await page.reload();
    await ready(page);
    assert.equal(await page.locator("#pins li").count(), 4);
    assert.notEqual(await page.evaluate(() => document.documentElement.dataset.theme), theme);
    await page.locator("#theme").click();
    for (let k = 0; k < 4; k++) await page.getByLabel(/^Unpin/).first().click();
    await reset();
});

test("nothing overflows at 390 px, and the drawing can be read", async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await ready(page);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 390);
    const smallest = await page.locator("#drawing svg text").evaluateAll((texts) => Math.min(...texts.map((own) => own.getBoundingClientRect().height)));
    assert.ok(smallest >= 8, String(smallest));
    await page.setViewportSize({ width: 1280, height: 800 });
});

test("at 390 px the circle of the multipliers and the drawings of circuits and stops are complete", async () => {
    const rectified = await serve({ kind: "bimorph-with-rectifier" });
    const own = await open(browser.context, rectified.address);
    for (const other of [own, page]) {
        await other.setViewportSize({ width: 390, height: 844 });
        await ready(other);
        const circle = await other.locator("#chart-multipliers canvas").evaluate((canvas) => {
            const [box, over] = [canvas.getBoundingClientRect(), document.querySelector("#chart-multipliers .u-over").getBoundingClientRect()];
            const ratio = canvas.width / box.width;
            const grey = getComputedStyle(document.documentElement).getPropertyValue("--grey").trim();
            const [r, g, b] = [1, 3, 5].map((k) => parseInt(grey.slice(k, k + 2), 16));
            const [left, top, width, height] = [over.left - box.left, over.top - box.top, over.width, over.height].map((own) => Math.round(own * ratio));
            const { data } = canvas.getContext("2d").getImageData(left, top, width, height);
            const found = [];
            for (let k = 0; k < data.length; k += 4) if (Math.abs(data[k] - r) + Math.abs(data[k + 1] - g) + Math.abs(data[k + 2] - b) < 24 && data[k + 3] > 150) found.push([(k / 4) % width, Math.floor(k / 4 / width)]);
            const [x, y] = [0, 1].map((axis) => found.map((at) => at[axis]));
            return { x: [Math.min(...x), Math.max(...x)], y: [Math.min(...y), Math.max(...y)], width, height };
        });
        const { x, y, width, height } = circle;
        assert.ok(x[0] > 0 && x[1] < width - 1 && y[0] > 0 && y[1] < height - 1 && Math.abs(x[1] - x[0] - (y[1] - y[0])) <= 4, JSON.stringify(circle));
        const cut = await other.locator("#close").evaluate((host) => [...host.children].filter((view) => view.getBoundingClientRect().right > host.getBoundingClientRect().right + 1).length);
        assert.equal(cut, 0);
        await other.setViewportSize({ width: 1280, height: 800 });
    }
    await own.close();
    await rectified.close();
});

test("a long status stays on one line", async () => {
    const height = (words) => page.locator("header").evaluate((own, status) => {
        own.querySelector("#reply").textContent = own.querySelector("#status").textContent = status;
        return own.getBoundingClientRect().height;
    }, words);
    for (const width of [1280, 820, 390]) {
        await page.setViewportSize({ width, height: 800 });
        await page.waitForTimeout(200);
        assert.equal(await height("a long status ".repeat(30)), await height("short"), String(width));
        await height("a long status ".repeat(30));
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width, String(width));
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.locator("h1").click();
    assert.equal(await page.locator("#reply").textContent(), "");
    // The page sets its own status again.
    await type("stop.tip.gap", "1.01");
    await page.locator("#reset").click();
    await ready(page);
});

test("no label of the drawing covers another one or is cut", async () => {
    await page.locator("#groups > details").evaluateAll((list) => list.forEach((group) => (group.open = true)));
    const moves = [["patch.mfc.length", "300"], ["patch.mfc.start", "200"], ["beam.beam.point.tip", "20"], ["beam.beam.point.tip", "100"], ["stop.tip.gap", "40"], ["stop.tip.gap", "0.001"], ["beam.beam.thickness", "9"], ["beam.beam.length", "3000"]];
    assert.ok((await page.locator("#drawing text").count()) > 5);
    for (const [key, value] of moves) {
        await type(key, value);
        await page.waitForFunction(() => document.getElementById("drawing").ariaBusy === "false");
        assert.deepEqual(await badLabels(page), [], `${key} ${value}`);
        await page.locator("#undo").click();
    }
    await reset();
});

test("without a stop there are no charts of contact", async () => {
    const linear = await serve({ example: "bimorph-erturk-2009/harvester.toml" });
    const own = await open(browser.context, linear.address);
    for (const id of ["chart-force", "chart-phase"]) assert.ok(await own.locator(`#${id}`).isHidden());
    assert.match(await own.locator("#chart-displacement").getAttribute("aria-label"), /End of shim/);
    const charts = await own.locator("#orbit-charts .chart:visible").evaluateAll((list) => list.map((chart) => chart.id));
    assert.ok(charts.length >= 4, charts.join());
    for (const id of charts) assert.ok((await inked(own, `#${id} canvas`)) > 0.03, id);
    await own.close();
    await linear.close();
});

test("a harvester without a load, whose power is 0, has its orbit at the operating point", async () => {
    const oscillator = await serve({ example: "bouncing-and-impact-oscillators/impact.toml" });
    const own = await open(browser.context, oscillator.address);
    await until("orbit-title", /^Orbit at 0\.12732 Hz: 0 W, period 1, stable$/, own);
    await own.close();
    await oscillator.close();
});

test("a spec without a drive opens on its free motion", async () => {
    const text = await readFile(server.spec, "utf8");
    const free = await serve({ text: text.replace(/\[drive\.shaker\][^[]*/, "") });
    const own = await browser.context.newPage();
    await own.goto(free.address);
    await until("operating-words", /the drives of the spec: [\d.]+ .?W on average/, own);
    assert.equal(await own.locator("#faults").textContent(), "");
    await own.close();
    await free.close();
});

for (const example of ["seismic-mass-jacquelin-2011", "missile-renaud-2009"]) {
    test(`a design that settles late shows its run and the response without contact while it integrates: ${example}`, async () => {
        const late = await serve({ example: `${example}/harvester.toml` });
        const own = await browser.context.newPage();
        await own.goto(late.address);
        await until("readout", /Draft: without contact only/, own);
        assert.ok((await inked(own, "#chart-response canvas")) > 0.005);
        assert.ok(await own.locator("#side > svg").isVisible());
        await until("operating-words", /the drives of the spec: [\d.]+ .?W on average .*starts/, own);
        assert.match(await own.locator("#chart-shake-voltage").getAttribute("aria-label"), /on average/);
        await own.locator("#operating-stop").click();
        await until("operating-words", /^Operating point: stopped/, own);
        await own.close();
        await late.close();
    });
}

test("a stop on a moving beam moves in the animation", async () => {
    const beams = await serve({ example: "two-beams-vijayan-2015/harvester.toml" });
    const own = await browser.context.newPage();
    await own.goto(beams.address);
    await until("readout", /Draft from|Draft: what|Peak|Largest/, own);
    await own.locator("#chart-response").focus();
    await own.keyboard.press("ArrowRight");
    await until("orbit-title", /Orbit at/, own);
    /** First row with the grey of the bar of the stop, right of the clamp. */
    const row = () => own.locator("#motion").evaluate((canvas) => {
        const [width, height] = [canvas.width, Math.round(canvas.height / 2)];
        const { data } = canvas.getContext("2d").getImageData(width - 60, 0, 60, height);
        for (let k = 0; k < data.length; k += 4) {
            if (data[k] === 138 && data[k + 1] === 138 && data[k + 2] === 138 && data[k + 3] === 255) return Math.floor(k / 240);
        }
        return undefined;
    });
    const rows = new Set();
    for (let look = 0; look < 30; look++) {
        rows.add(await row());
        await own.waitForTimeout(50);
    }
    rows.delete(undefined);
    assert.ok(rows.size > 2, [...rows].join());
    await own.close();
    await beams.close();
});

test("free motion opens on its time history", async () => {
    const shock = await serve({ example: "shock-cavallier-2005/harvester.toml" });
    const own = await browser.context.newPage();
    await own.goto(shock.address);
    await until("operating-words", /the drives of the spec: [\d.]+ .?W on average/, own);
    assert.equal(await own.locator("#faults").textContent(), "");
    await own.close();
    await shock.close();
});

test("a search can be stopped and says how far it is", async () => {
    const heavy = await serve({ kind: "cantilever-with-stop" });
    const own = await browser.context.newPage();
    await own.goto(heavy.address);
    await until("busy", /draft, searching: \d+ of \d+/, own);
    await own.locator("#response-stop").click();
    await until("busy", /search stopped/, own);
    assert.match(await own.locator("#readout").textContent(), /^Draft/);
    await own.close();
    await heavy.close();
});

test("a page beyond the limit of the server says that, and not that the server has stopped", async () => {
    const refused = await browser.context.newPage();
    await refused.addInitScript(() => {
        window.WebSocket = class extends EventTarget {
            constructor() {
                super();
                setTimeout(() => this.onclose?.(), 10);
            }
        };
    });
    await refused.goto(server.address);
    await until("lost-words", /too many open pages/, refused);
    await refused.close();
});

test("work that a stopped server has lost does not seem to run", async () => {
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("3721");
    await page.locator("#basins-run").click();
    await until("basins-words", /s left/);
    await server.stop();
    await until("basins-words", /the connection was lost/);
    assert.ok(await page.locator("#basins-progress").isHidden());
    await server.start();
    await page.locator("#lost").waitFor({ state: "hidden" });
});
