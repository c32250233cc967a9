// What the page shows is so: attractors, drafts, older results, faults, warnings, the operating point.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readFile, writeFile } from "node:fs/promises";
import { test } from "node:test";
import { promisify } from "node:util";
import { program, ready, serve } from "./browser.mjs";
import { browser, page, server, type, until } from "./suite.mjs";

const run = promisify(execFile);
const text = (id) => page.locator(`#${id}`).textContent();
const reset = async () => {
    if (await page.locator("#reset").isEnabled()) await page.locator("#reset").click();
    await ready(page);
};
/** Colours of the pixels of a chart, most frequent first, without those of the background. */
const colours = (selector) => page.locator(`${selector} canvas`).evaluate((canvas) => {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const counts = new Map();
    for (let k = 0; k < data.length; k += 4) {
        if (data[k + 3] > 250) counts.set(`${data[k]},${data[k + 1]},${data[k + 2]}`, (counts.get(`${data[k]},${data[k + 1]},${data[k + 2]}`) ?? 0) + 1);
    }
    return [...counts].sort((a, b) => b[1] - a[1]);
});

test("the page opens on the operating point of the spec, as the command line gives it", async () => {
    await until("operating-words", /of 100 starts/);
    const { stdout } = await run(program, ["run", server.spec, "--json"]);
    const words = await text("operating-words");
    const microwatts = Number(words.match(/At 13 Hz: ([\d.]+) µW, period 1, stable, reached by 100 % \(95 %: 96 to 100\) of 100 starts/)[1]);
    assert.ok(Math.abs(microwatts / 1e6 / JSON.parse(stdout).mean_power_w - 1) < 1e-3, words);
    assert.match(await text("orbit-title"), new RegExp(`Orbit at 13 Hz: ${microwatts} µW`));
});

test("the line at the drive frequency is tied to the slider", async () => {
    const chart = page.locator("#chart-response .u-over");
    const box = await chart.boundingBox();
    const at = (hertz) => box.x + (box.width * (hertz - 11.44)) / (14.82 - 11.44);
    await page.mouse.move(at(13), box.y + 20);
    await page.mouse.down();
    await page.mouse.move(at(13.5), box.y + 20, { steps: 5 });
    await page.mouse.up();
    await until("operating-words", /At 13\.(49|5)\d* Hz: .*reached by/);
    const value = Number(await page.getByLabel("drive.shaker.frequency, value", { exact: true }).inputValue());
    assert.ok(Math.abs(value - 13.5) < 0.02, String(value));
    await until("orbit-title", /Orbit at 13\.(49|5)\d* Hz/);
    await reset();
    await until("orbit-title", /Orbit at 13 Hz/);
    // And the slider moves the line.
    const line = () => page.locator("#chart-response canvas").evaluate((canvas) => canvas.toDataURL());
    const before = await line();
    await page.getByRole("slider", { name: "drive.shaker.frequency", exact: true }).focus();
    for (let k = 0; k < 20; k++) await page.keyboard.press("ArrowRight");
    await until("operating-words", /At 13\.\d+ Hz: .*reached by/);
    await until("orbit-title", /Orbit at 13\.\d+ Hz/);
    assert.notEqual(await line(), before);
    await reset();
    await until("orbit-title", /Orbit at 13 Hz/);
});

test("basins: the attractors of the command line, cells without gaps, the interval of the expected power", async () => {
    await type("drive.shaker.frequency", "12.55");
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-run").click();
    await until("basins-words", /12\.55 Hz: expected power .* \(95 %: .* to .*W\)/);
    const { stdout } = await run(program, ["basins", server.spec, "--set", "drive.shaker.frequency=12.55Hz", "--json"]);
    const due = JSON.parse(stdout).attractors.map((own) => own.id);
    const shown = await page.locator("#attractors li").allTextContents();
    assert.deepEqual(shown.map((own) => own.split(":")[0]), due);
    // A grid covers its plane: no pixel inside it has the colour of the grid lines or of the paper.
    const bare = await page.locator("#chart-basins canvas").evaluate((canvas) => {
        const over = document.querySelector("#chart-basins .u-over").getBoundingClientRect();
        const box = canvas.getBoundingClientRect();
        const ratio = canvas.width / box.width;
        const { data } = canvas.getContext("2d").getImageData((over.left - box.left + 3) * ratio, (over.top - box.top + 3) * ratio, (over.width - 6) * ratio, (over.height - 6) * ratio);
        const counts = new Map();
        for (let k = 0; k < data.length; k += 4) counts.set(data.slice(k, k + 4).join(), (counts.get(data.slice(k, k + 4).join()) ?? 0) + 1);
        return [...counts.keys()];
    });
    assert.equal(bare.length, due.length, bare.join(" "));
});

test("basins: as many colours as attractors, also after six", async () => {
    const other = await browser.context.newPage();
    // The frame of the map, as if its starts reached nine attractors.
    await other.addInitScript(() => {
        const COUNT = 9;
        const many = (data) => {
            const length = new DataView(data).getUint32(0, true);
            const head = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
            if (head.ask !== "basins" || head.stage !== "done") return data;
            const [, first, size] = head.arrays.find(([name]) => name === "attractor");
            head.attractors = Array.from({ length: COUNT }, (_, k) => ({ ...head.attractors[0], id: `A${k}` }));
            const words = new TextEncoder().encode(JSON.stringify(head));
            const padded = Math.ceil((words.length + 4) / 8) * 8 - 4;
            const numbers = new Float64Array(data.slice(4 + length));
            for (let k = 0; k < size; k++) numbers[first + k] = k % COUNT;
            const bytes = new Uint8Array(4 + padded + numbers.byteLength).fill(32);
            new DataView(bytes.buffer).setUint32(0, padded, true);
            bytes.set(words, 4);
            bytes.set(new Uint8Array(numbers.buffer), 4 + padded);
            return bytes.buffer;
        };
        const Real = window.WebSocket;
        window.WebSocket = class extends Real {
            set onmessage(hear) {
                super.onmessage = ({ data }) => hear({ data: many(data) });
            }
        };
    });
    await other.goto(server.address);
    await ready(other);
    await other.locator("#tab-basins").click();
    await other.locator("#basins-starts").selectOption("225");
    await other.locator("#basins-run").click();
    await until("basins-words", /expected power/, other);
    const named = await other.locator("#attractors li").evaluateAll((list) => list.map((own) => getComputedStyle(own).getPropertyValue("--own")));
    assert.equal(new Set(named).size, 9, named.join());
    const drawn = await other.locator("#chart-basins canvas").evaluate((canvas) => {
        const over = document.querySelector("#chart-basins .u-over").getBoundingClientRect();
        const box = canvas.getBoundingClientRect();
        const ratio = canvas.width / box.width;
        const { data } = canvas.getContext("2d").getImageData((over.left - box.left + 3) * ratio, (over.top - box.top + 3) * ratio, (over.width - 6) * ratio, (over.height - 6) * ratio);
        const counts = new Map();
        for (let k = 0; k < data.length; k += 4) counts.set(data.slice(k, k + 4).join(), (counts.get(data.slice(k, k + 4).join()) ?? 0) + 1);
        // Without the mixtures at the edges of the cells.
        return [...counts.values()].filter((count) => count > 100).length;
    });
    assert.equal(drawn, 9);
    await other.close();
});

test("a result of an earlier design says so, until the design is that one again", async () => {
    assert.ok(await page.locator("#basins-stale").isHidden());
    await type("stop.tip.gap", "1.1");
    await page.locator("#basins-stale").waitFor({ state: "visible" });
    await page.keyboard.press("Escape");
    await page.locator("#undo").click();
    await page.locator("#basins-stale").waitFor({ state: "hidden" });
    // Until the field has the value of the file again, the same text changes nothing.
    await ready(page);
    await page.locator("#tab-load").click();
    await until("load-words", /[3-9] of \d+ values computed/);
    assert.ok(await page.locator("#load-stale").isHidden());
    await type("stop.tip.gap", "1.1");
    await page.locator("#load-stale").waitFor({ state: "visible" });
    await page.locator("#undo").click();
    await page.locator("#load-stale").waitFor({ state: "hidden" });
    await page.locator("#load-run").click();
    await page.locator("#tab-response").click();
    await reset();
    await page.locator("#sweep").click();
    await until("status", /[3-9] of \d+ values computed/);
    await page.locator("#sweep").click();
    assert.doesNotMatch(await text("readout"), /earlier design/);
    await type("stop.tip.gap", "1.1");
    await until("readout", /swept points are of an earlier design/);
    await reset();
});

test("a pin over another key is not drawn and says so", async () => {
    await page.locator("#pin").click();
    await page.locator("#over").selectOption("stop.tip.gap");
    await ready(page);
    assert.match(await text("pins"), /over drive\.shaker\.frequency/);
    await page.locator("#over").selectOption("drive.shaker.frequency");
    await ready(page);
    assert.doesNotMatch(await text("pins"), /over drive/);
    await page.getByLabel(/^Unpin/).click();
});

test("a draft is faded, has no marks, and says that it is one", async () => {
    const slider = page.getByRole("slider", { name: "stop.tip.gap", exact: true });
    const seen = await slider.evaluate(async (element) => {
        let [drafts, marked, faded] = [0, 0, 0];
        const canvas = document.querySelector("#chart-response canvas");
        const words = [];
        for (let move = 0; move < 30; move++) {
            element.value = String(330 + 4 * move);
            element.dispatchEvent(new Event("input"));
            await new Promise((resolve) => setTimeout(resolve, 60));
            if (!/Draft/.test(document.getElementById("readout").textContent)) continue;
            drafts++;
            marked += document.querySelectorAll("#bifurcations tr").length > 0 && !document.querySelector(".readout details").hidden ? 1 : 0;
            const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
            for (let k = 3; k < data.length; k += 4) faded += data[k] > 95 && data[k] < 110 ? 1 : 0;
            words.push(document.getElementById("busy").textContent);
        }
        element.dispatchEvent(new Event("change"));
        return { drafts, marked, faded, words };
    });
    assert.ok(seen.drafts > 5, JSON.stringify(seen));
    assert.equal(seen.marked, 0);
    assert.ok(seen.faded / seen.drafts > 200, String(seen.faded));
    await ready(page);
    assert.doesNotMatch(await text("readout"), /Draft/);
    await reset();
});

test("a draft says how far it is off, what it has lost, and that new branches are missing", async () => {
    const slider = page.getByRole("slider", { name: "stop.tip.gap", exact: true });
    const words = await slider.evaluate(async (element) => {
        const heard = new Set();
        for (const value of [330, 500, 165, 800, 330]) {
            element.value = String(value);
            element.dispatchEvent(new Event("input"));
            for (let look = 0; look < 20; look++) {
                await new Promise((resolve) => setTimeout(resolve, 50));
                heard.add(document.getElementById("readout").textContent);
            }
        }
        element.dispatchEvent(new Event("change"));
        return [...heard].filter((own) => own.startsWith("Draft"));
    });
    assert.ok(words.length > 0);
    for (const own of words) assert.match(own, /^Draft: of an earlier design; curves may be wrong or missing|^Draft.*: (lines within [\d.e-]+ % of the range or [\d.e-]+ % of the power|no curve is known well enough to be drawn);.* curves may be missing until the search ends/);
    await ready(page);
    await reset();
});

test("a branch keeps its colour when the design changes", async () => {
    const strongest = async () => (await colours("#chart-response")).filter(([own]) => new Set(own.split(",")).size === 3).slice(0, 1).map(([own]) => own);
    const before = await strongest();
    for (const gap of ["1.1", "1.2", "1.1", "1"]) {
        await type("stop.tip.gap", gap);
        await ready(page);
        assert.deepEqual(await strongest(), before, gap);
    }
    await reset();
});

test("the fine result says what its search may miss", async () => {
    assert.match(await text("note"), /^The search misses branches that none of 6 seeds converges to, and branches of a period above 2 cycles\.$/);
    await page.locator("#long-periods").check();
    await until("note", /branches of a period above 8 cycles/);
    await page.locator("#long-periods").uncheck();
    await ready(page);
});

test("the numbers of stable orbits are those of `jounce basins`", async () => {
    await until("readout", /Stable orbits found: .* then \d+\./);
    const words = (await text("readout")).match(/Stable orbits found: (.*?), then (\d+)\./);
    const parts = words[1].split(", ").map((part) => part.match(/^(\d+|no stable periodic orbit) up to ([\d.]+) Hz$/).slice(1).map((own) => (own.startsWith("no") ? 0 : Number(own))));
    const ends = [11.44, ...parts.map(([, to]) => to), 14.82];
    const orbits = [...parts.map(([own]) => own), Number(words[2])];
    for (const [k, due] of orbits.entries()) {
        const hertz = (ends[k] + ends[k + 1]) / 2;
        const { stdout } = await run(program, ["basins", server.spec, "--set", `drive.shaker.frequency=${hertz}Hz`, "--starts", "200", "--json"]);
        // The search has no longer periods.
        const found = JSON.parse(stdout).attractors.filter(({ period_cycles }) => period_cycles === 1 || period_cycles === 2);
        assert.equal(found.length, due, `${hertz} Hz: ${JSON.stringify(found.map(({ id }) => id))} ${words[0]}`);
    }
});

test("a fault stays until its cause is gone", async () => {
    await page.locator("#from").fill("0");
    await page.locator("#to").fill("20");
    await page.locator("#to").press("Enter");
    const fault = page.locator("#control-drive-shaker-frequency-fault");
    await fault.waitFor({ state: "visible" });
    assert.match(await fault.textContent(), /frequency/);
    await type("stop.tip.gap", "1.05");
    await page.waitForTimeout(1000);
    assert.ok(await fault.isVisible());
    await page.locator("#from").fill("11.44");
    await page.locator("#to").fill("14.82");
    await page.locator("#to").press("Enter");
    await fault.waitFor({ state: "hidden" });
    await reset();
    await page.locator("#from").fill("15");
    await page.locator("#from").press("Enter");
    await until("range-fault", /smaller to a larger/);
    await type("stop.tip.gap", "1");
    await page.waitForTimeout(500);
    assert.match(await text("range-fault"), /smaller to a larger/);
    await page.locator("#from").fill("11.44");
    await page.locator("#from").press("Enter");
    await page.waitForFunction(() => document.getElementById("range-fault").textContent === "");
    await ready(page);
});

test("the edge of the range is not called a peak", async () => {
    await until("readout", /Peak 7\.8\d+ mW at 12\.55/);
    await page.locator("#from").fill("13.1");
    await page.locator("#from").press("Enter");
    await until("readout", /Largest stable power in the range: .* no peak/);
    assert.doesNotMatch(await text("readout"), /bandwidth/);
    await page.locator("#from").fill("12.54");
    await page.locator("#from").press("Enter");
    await until("readout", /Peak .*at least/);
    await page.locator("#from").fill("11.44");
    await page.locator("#from").press("Enter");
    await ready(page);
});

test("a deflection beyond the linear model and exceeded limits of the patch are on the page", async () => {
    await type("drive.shaker.frequency", "12.55");
    await until("orbit-title", /Orbit at 12\.55 Hz: 7\.\d+ mW/);
    await until("operating-warnings", /deflection reaches \d+ % of its length; the linear model holds/);
    assert.match(await text("orbit-warnings"), /^beam: its deflection reaches/);
    await reset();
    await page.waitForFunction(() => document.getElementById("operating-warnings").hidden);
});

test("excitation: the drives of the spec give the power of `jounce run`", async () => {
    const random = await serve({ example: "random-base/harvester.toml" });
    const own = await browser.context.newPage();
    await own.goto(random.address);
    await until("operating-words", /the drives of the spec: [\d.]+ .?W on average/, own);
    const { stdout } = await run(program, ["run", random.spec, "--json"]);
    const words = await own.locator("#operating-words").textContent();
    const [, number, prefix] = words.match(/: ([\d.]+) (.?)W on average/);
    const watt = Number(number) * { m: 1e-3, µ: 1e-6, n: 1e-9, "": 1 }[prefix];
    assert.ok(Math.abs(watt / JSON.parse(stdout).mean_power_w - 1) < 1e-3, `${words} ${stdout}`);
    assert.equal(await own.locator("#faults").textContent(), "");
    assert.equal(await own.getAttribute("#tab-shake", "aria-selected"), "true");
    await own.close();
    await random.close();
});

test("the operating point gives the strain with its limit, and a limit that is exceeded", async () => {
    const spec = await readFile(server.spec, "utf8");
    const limited = (ppm) => writeFile(server.spec, spec.replace("[patch.mfc] ", `[patch.mfc]\nstrain_limit = ${ppm}e-6\n#`));
    await limited(600);
    await until("operating-words", /At 13 Hz: .*, strain [\d.]+ ppm of 600,/);
    const reached = Number((await text("operating-words")).match(/strain ([\d.]+) ppm/)[1]);
    await limited(Math.floor(reached / 2));
    await until("operating-safety", /the strain of patch mfc is [\d.]+ ppm, 10\d(\.\d)? % beyond its limit of \d+ ppm\.$/);
    await writeFile(server.spec, spec);
    await until("operating-safety", /no limit given/);
    assert.ok(await page.locator("#operating-warnings").isHidden());
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
