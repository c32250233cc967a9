// Order of responses: the page holds responses back and lets them in late, as a busy machine does. None of them may overwrite what is newer.
import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { browse, open, ready, serve } from "./browser.mjs";
import { gate } from "./gate.mjs";

let server;
let browser;
let page;
before(async () => {
    server = await serve();
    browser = await browse();
    page = await open(browser.context, server.address, gate);
    await until("operating-words", /of 100 starts/);
});
after(async () => {
    await browser?.close();
    await server?.close();
});

const text = (id) => page.locator(`#${id}`).textContent();
const until = (id, pattern) => page.waitForFunction(([name, source]) => new RegExp(source).test(document.getElementById(name).textContent), [id, pattern.source]);
const field = (key) => page.getByLabel(`${key}, value`, { exact: true });
const type = async (key, value) => {
    await field(key).fill(value);
    await field(key).press("Enter");
};
const hold = (pattern) => page.evaluate((source) => window.gate.hold(source), pattern.source);
const held = (count = 1) => page.waitForFunction((least) => window.gate.waiting() >= least, count);
const letIn = () => page.evaluate(() => window.gate.open());
const reset = async () => {
    await letIn();
    if (await page.locator("#reset").isEnabled()) await page.locator("#reset").click();
    await ready(page);
    await until("operating-words", /of 100 starts/);
};
const drop = (name, content) => page.evaluate(([file, own]) => {
    const data = new DataTransfer();
    data.items.add(new File([own], file, { type: "text/csv" }));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
}, [name, content]);
const sine = ["time (s),force", ...Array.from({ length: 3001 }, (_, k) => `${k / 1000},${(200 * Math.sin(2 * Math.PI * 13 * k / 1000)).toFixed(6)}`)].join("\n");

test("text that is being typed remains when a design arrives", async () => {
    await hold(/^design done/);
    await page.locator("#from").fill("12");
    await page.locator("#to").fill("14");
    await held();
    await field("stop.tip.gap").focus();
    await page.keyboard.type("7");
    const typed = await field("stop.tip.gap").inputValue();
    await page.locator("#from").fill("11.9");
    await page.evaluate(() => window.gate.open());
    assert.equal(await page.locator("#from").inputValue(), "11.9");
    await page.locator("#from").press("Enter");
    assert.equal(await page.locator("#from").inputValue(), "11.9");
    assert.equal(await page.locator("#to").inputValue(), "14");
    assert.match(await field("stop.tip.gap").inputValue(), new RegExp(typed));
    await page.locator("#from").fill("11.44");
    await page.locator("#to").fill("14.82");
    await page.locator("#to").press("Enter");
    await reset();
});

test("a design that arrives late does not move a slider back", async () => {
    const slider = page.getByRole("slider", { name: "stop.tip.gap", exact: true });
    await slider.focus();
    const before = Number(await slider.inputValue());
    await hold(/^design done/);
    await page.keyboard.press("ArrowRight");
    await held();
    for (let k = 0; k < 4; k++) await page.keyboard.press("ArrowRight");
    await letIn();
    assert.equal(Number(await slider.inputValue()), before + 5);
    await page.keyboard.press("ArrowRight");
    await ready(page);
    assert.equal(Number(await slider.inputValue()), before + 6);
    await reset();
});

test("noise runs while a file is read and checked, and the results have the names of their own runs", async () => {
    await page.locator("#tab-shake").click();
    await hold(/^shake/);
    await drop("picture.png", "\u0089PNG\r\n");
    await until("shake-words", /picture\.png/);
    await page.locator("#shake-run").click();
    await letIn();
    await until("shake-words", /^other noise: [\d.]+ .?W on average over 45 s/);
    // A result that arrives while another file is read.
    await hold(/^shake done/);
    await page.locator("#shake-run").click();
    await held();
    await page.evaluate(() => window.gate.holdFiles("late"));
    await drop("late.csv", sine);
    await letIn();
    assert.doesNotMatch(await text("shake-words"), /late\.csv.*W on average/);
    // A newer file that is read sooner.
    await drop("newer.csv", sine);
    await until("shake-words", /^newer\.csv \(.+\): [\d.]+ .?W on average over 3 s/);
    await page.evaluate(() => window.gate.openFiles());
    await page.waitForTimeout(300);
    assert.match(await text("shake-words"), /^newer\.csv \(/);
});

test("a design that settles late does not put its run in place of that of the user", async () => {
    const words = await text("shake-words");
    await hold(/^operating-point/);
    await type("stop.tip.gap", "1.1");
    await page.locator("#operating-stop").waitFor({ state: "visible" });
    await page.waitForTimeout(300);
    assert.equal(await text("shake-words"), words);
    await reset();
});

test("after Stop nothing seems to run, and a map of an earlier design remains one", async () => {
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-run").click();
    await until("basins-words", /expected power/);
    await type("stop.tip.gap", "1.1");
    await page.locator("#basins-stale").waitFor({ state: "visible" });
    await page.locator("#basins-starts").selectOption("3721");
    await hold(/^basins progress/);
    await page.locator("#basins-run").click();
    await held();
    assert.ok(await page.locator("#basins-stale").isVisible(), "while the new one is computed");
    await page.locator("#basins-run").click();
    await letIn();
    assert.equal(await text("basins-words"), "stopped");
    assert.ok(await page.locator("#basins-stale").isVisible(), "after Stop");
    await page.locator("#tab-response").click();
    await reset();
});

test("the attractor of an earlier design is not that of the present one", async () => {
    await hold(/^operating-point done/);
    await type("stop.tip.gap", "1.1");
    await held();
    await page.evaluate(() => {
        window.seen = [];
        new MutationObserver(() => window.seen.push(document.getElementById("operating-words").textContent)).observe(document.getElementById("operating-words"), { childList: true, characterData: true, subtree: true });
    });
    const slider = page.getByRole("slider", { name: "stop.tip.gap", exact: true });
    await slider.evaluate((element) => {
        element.value = "800";
        element.dispatchEvent(new Event("input"));
        element.dispatchEvent(new Event("change"));
        window.gate.open();
    });
    await until("operating-words", /reached by .* of 100 starts/);
    const seen = (await page.evaluate(() => window.seen)).filter((words) => words.startsWith("At "));
    assert.equal(new Set(seen.map((words) => words.match(/: ([\d.]+ .?W)/)[1])).size, 1, seen.join("\n"));
    await reset();
});

test("a fault of the search remains until a search has ended without it", async () => {
    const message = "this took longer than 60 s and was stopped";
    await page.evaluate((words) => window.gate.fault("response", words), message);
    assert.equal(await text("faults"), message);
    await hold(/^response (fine|widths)/);
    await type("stop.tip.gap", "1.05");
    await until("readout", /^Draft(?!: of an earlier)/);
    assert.equal(await text("faults"), message, "with the draft of another design");
    await letIn();
    await ready(page);
    assert.equal(await text("faults"), "");
    await reset();
});

test("curves, bifurcations and orbit of an earlier design are marked until the new ones arrive", async () => {
    await hold(/^response/);
    await type("stop.tip.gap", "1.1");
    await until("readout", /of an earlier design/);
    await held();
    assert.ok(await page.locator(".readout details").first().isHidden());
    assert.ok(await page.locator("#orbit-stale").isVisible());
    await letIn();
    await ready(page);
    assert.doesNotMatch(await text("readout"), /earlier design/);
    assert.ok(await page.locator("#orbit-stale").isHidden());
    await reset();
});

test("swept points remain on their own key, and the search for longer periods does not make them old", async () => {
    await page.locator("#sweep").click();
    await until("status", /[3-9] of \d+ values computed/);
    await page.locator("#sweep").click();
    await page.locator("#long-periods").check();
    await page.waitForTimeout(100);
    assert.doesNotMatch(await text("readout"), /swept points are of an earlier design/);
    await page.locator("#long-periods").uncheck();
    await ready(page);
});

test("a file whose drives lose their period leaves no fault of the response", async () => {
    const spec = await readFile(server.spec, "utf8");
    await writeFile(server.spec, spec.replace(/\[drive\.shaker\][^[]*/, ""));
    await until("operating-words", /the drives of the spec: [\d.]+ .?W on average/);
    assert.equal(await text("faults"), "");
    await writeFile(server.spec, spec);
    await until("operating-words", /At 13 Hz/);
    await ready(page);
});

test("a band of tolerances is requested once for a design, after its search", async () => {
    await page.locator("#tab-design").click();
    await page.locator("#robust").check();
    await page.getByLabel("Add a tolerance", { exact: true }).selectOption("stop.tip.gap");
    await page.getByLabel("Add this tolerance", { exact: true }).click();
    await until("robust-words", /shaded/);
    await page.evaluate(() => {
        window.bands = 0;
        const { send } = Object.getPrototypeOf(window.WebSocket.prototype);
        window.WebSocket.prototype.send = function (words) {
            window.bands += JSON.parse(words).ask === "band" ? 1 : 0;
            send.call(this, words);
        };
    });
    await hold(/^response/);
    // The operating point lies at another point of the old branches.
    await page.evaluate(() => (location.hash = "set=stop.tip.gap%3D1.1+mm&set=drive.shaker.frequency%3D12.3+Hz"));
    // The operating point is known before the branches.
    await until("operating-words", /of 100 starts/);
    await held();
    assert.equal(await page.evaluate(() => window.bands), 0);
    await letIn();
    await until("robust-words", /shaded/);
    assert.equal(await page.evaluate(() => window.bands), 1);
    await page.locator("#robust").uncheck();
    await page.locator("#tab-response").click();
    await reset();
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
