// The file of a study, opened without a server: chart, read-out, choices, table, print.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { browse, inked, program } from "./browser.mjs";
import { missing, read } from "./paper.mjs";

const axeSource = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const spec = new URL("../../examples/impact-harvester-2019/harvester.toml", import.meta.url).pathname;
const STUDY = `spec = ${JSON.stringify(spec)}
[set]
"run.duration" = "2 s"
"run.average_over" = "1 s"
[vary]
"stop.tip.gap" = "0.5mm:1.5mm:3x"
"drive.shaker.frequency" = "10Hz:14Hz:21x"
"circuit.load.resistance" = "100kohm:1Mohm:2log"
`;

const POINTS = 126;

let folder;
let browser;
let page;
let address;
const requests = [];

before(async () => {
    folder = await mkdtemp(join(tmpdir(), "study-"));
    await writeFile(join(folder, "study.toml"), STUDY);
    for (const line of ["study run study.toml --out power", "study page power"]) {
        const { status, stderr } = spawnSync(program, line.split(" "), { cwd: folder, encoding: "utf8" });
        assert.equal(status, 0, stderr);
    }
    address = pathToFileURL(join(folder, "power.html")).href;
    browser = await browse();
    page = await browser.context.newPage();
    page.faults = [];
    page.on("pageerror", (error) => page.faults.push(String(error)));
    page.on("console", (message) => ["error", "warning"].includes(message.type()) && page.faults.push(message.text()));
    page.on("request", (request) => requests.push(request.url()));
    await page.goto(address);
});
after(async () => {
    await browser?.close();
    await rm(folder, { recursive: true, force: true });
});

const data = () => page.evaluate(() => JSON.parse(document.getElementById("table").textContent));
const chosen = (id) => page.locator(`#${id}`).inputValue();

test("the file opens without a server and shows chart and table", async () => {
    assert.equal(await page.title(), "power");
    assert.match(await page.locator("#summary").textContent(), /^126 points over stop\.tip\.gap, drive\.shaker\.frequency, circuit\.load\.resistance\.$/);
    assert.ok((await inked(page, "#chart canvas")) > 0.003);
    assert.equal(await page.locator("#rows tbody tr").count(), POINTS);
    assert.equal(await page.locator("#legend li:not(.unsettled)").count(), 3);
    assert.equal(await page.locator("#drawn").textContent(), "63 of 126 points drawn");
    assert.deepEqual(page.faults, []);
    assert.deepEqual(requests.filter((url) => url.split("#")[0] !== address), []);
    // The picture of the book: `STUDY_PICTURE=book/src/pictures/study-page.png node web/tests/all.mjs`.
    if (process.env.STUDY_PICTURE) await page.screenshot({ path: process.env.STUDY_PICTURE });
});

test("points that had not settled have a ring, with its name in the legend", async () => {
    const { columns, values } = await data();
    const column = (name) => values[columns.findIndex((one) => one.name === name)];
    const [settled, periods] = [column("settled"), column("period_cycles")];
    assert.ok(settled.some((yes, row) => !yes && periods[row] > 0), "runs of 2 s have not all settled");
    assert.deepEqual(await page.locator("#legend li.unsettled").allTextContents(), ["not settled"]);
    // The same file with every point settled has no ring, and less ink.
    const k = columns.findIndex((one) => one.name === "settled");
    values[k] = values[k].map(() => true);
    const table = { ...(await data()), values };
    const text = await readFile(join(folder, "power.html"), "utf8");
    const stored = await page.evaluate(() => document.getElementById("table").textContent);
    await writeFile(join(folder, "settled.html"), text.replace(stored, () => JSON.stringify(table)));
    const ink = [];
    for (const [name, rings] of [["power", 1], ["settled", 0]]) {
        const other = await browser.context.newPage();
        await other.goto(pathToFileURL(join(folder, `${name}.html`)).href);
        assert.equal(await other.locator("#legend li.unsettled").count(), rings);
        ink.push(await inked(other, "#chart canvas"));
        await other.close();
    }
    assert.ok(ink[0] > ink[1], `ink with rings ${ink[0]}, without ${ink[1]}`);
});

test("the key with the most values is the horizontal axis, the first other key the group", async () => {
    assert.deepEqual([await chosen("x"), await chosen("group")], ["drive.shaker.frequency", "stop.tip.gap"]);
});

test("the table has the units of the axes", async () => {
    const { columns, values } = await data();
    const column = columns.findIndex(({ name }) => name === "stop.tip.gap");
    assert.equal(await page.locator("#rows thead th").nth(column).locator("span").textContent(), "mm");
    const cells = await page.locator(`#rows tbody td:nth-child(${column + 1})`).allTextContents();
    assert.deepEqual(cells.map(Number), values[column].map((gap_m) => Number((1e3 * gap_m).toPrecision(6))));
});

test("the axis of a flag runs from no to yes, also where all points have the same", async () => {
    const { columns, values } = await data();
    const settled = values[columns.findIndex(({ name }) => name === "settled")];
    assert.ok(settled.every((own) => !own), "2 s are too short for each point");
    await page.locator("#y").selectOption("settled");
    await page.locator("#chart").focus();
    await page.keyboard.press("ArrowRight");
    assert.match(await page.locator("#cursor").textContent(), / no, stop/);
    const [dot, area] = await Promise.all([".cursor.dot", ".u-over"].map((name) => page.locator(`#chart ${name}`).boundingBox()));
    const height = (area.y + area.height - dot.y - dot.height / 2) / area.height;
    assert.ok(Math.abs(height - 0.06 / 1.12) < 0.01, `${height}`);
    await page.locator("#y").selectOption("mean_power_w");
});

test("the downloaded table has all digits of the study", async () => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#csv").click()]);
    const path = join(folder, "downloaded.csv");
    await download.saveAs(path);
    const [head, ...rows] = (await readFile(path, "utf8")).trimEnd().split("\n").map((line) => line.split(","));
    const { columns, values } = await data();
    assert.deepEqual(head, columns.map(({ name }) => name));
    assert.equal(rows.length, POINTS);
    rows.forEach((row, k) => row.forEach((cell, column) => {
        const due = values[column][k];
        assert.ok(["text", "flag"].includes(columns[column].kind) ? cell === String(due) : Object.is(Number(cell), Number(due)), `${head[column]} ${k}: ${cell} ${due}`);
    }));
});

test("a print has its chart as vectors with letters inside, which can be saved too", { skip: missing }, async () => {
    const path = join(folder, "print.pdf");
    await page.pdf({ path, preferCSSPageSize: true });
    const { images, outside, text } = read(path);
    assert.deepEqual([images, outside], [0, []]);
    for (const words of ["drive.shaker.frequency (Hz)", "10.5", "126 points over"]) assert.ok(text.includes(words), `${words}\n${text}`);
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#svg").click()]);
    await download.saveAs(join(folder, "chart.svg"));
    const svg = await readFile(join(folder, "chart.svg"), "utf8");
    assert.ok(svg.includes(">drive.shaker.frequency (Hz)</text>") && !svg.includes("<image"), svg);
});

test("the mouse and the arrow keys read the value of a point", async () => {
    await page.locator("#chart").focus();
    await page.keyboard.press("ArrowRight");
    const words = await page.locator("#cursor").textContent();
    assert.match(words, /^mean power of all loads [\d.]+ .?W, stop\.tip\.gap 500 µm, drive\.shaker\.frequency 10 Hz, circuit\.load\.resistance 100 kΩ$/);
    const { columns, values } = await data();
    const power = values[columns.findIndex(({ name }) => name === "mean_power_w")][0];
    const [, number, unit] = words.match(/loads ([\d.]+) (.?)W/);
    const shown = Number(number) * { m: 1e-3, µ: 1e-6, n: 1e-9, "": 1 }[unit];
    assert.ok(Math.abs(shown / power - 1) < 1e-3, `${words}: ${power}`);
    assert.equal(await page.locator("#rows .marked").getAttribute("data-row"), "0");
    const dot = await page.locator(".cursor.dot").boundingBox();
    await page.keyboard.press("ArrowRight");
    assert.notEqual(await page.locator("#cursor").textContent(), words);
    await page.mouse.move(dot.x + dot.width / 2, dot.y + dot.height / 2);
    // The points of other gaps are next to this one.
    await page.waitForFunction(() => /drive\.shaker\.frequency 10 Hz/.test(document.getElementById("cursor").textContent));
});

test("quantity, axis, group and the other keys are chosen, and the address keeps them", async () => {
    await page.locator("#y").selectOption("voltage_rms_v");
    await page.locator("#x").selectOption("stop.tip.gap");
    await page.locator("#group").selectOption("circuit.load.resistance");
    const frequency = page.getByLabel("drive.shaker.frequency", { exact: true });
    await frequency.selectOption({ label: "12 Hz" });
    assert.match(await page.locator("#chart").getAttribute("aria-label"), /^voltage.* over stop\.tip\.gap;/);
    assert.equal(await page.locator("#drawn").textContent(), "6 of 126 points drawn");
    await frequency.selectOption({ label: "all values" });
    assert.equal(await page.locator("#drawn").textContent(), "126 of 126 points drawn");
    await page.locator("#log-y").check();
    await page.reload();
    assert.deepEqual([await chosen("y"), await chosen("x"), await chosen("group"), await frequency.inputValue()], ["voltage_rms_v", "stop.tip.gap", "circuit.load.resistance", ""]);
    assert.ok(await page.locator("#log-y").isChecked());
    assert.equal(await page.locator("#drawn").textContent(), "126 of 126 points drawn");
    assert.ok((await inked(page, "#chart canvas")) > 0.003);
});

test("a click on a name sorts the table", async () => {
    const name = page.getByRole("button", { name: "mean_power_w" });
    const { columns, values } = await data();
    const due = [...values[columns.findIndex(({ name: own }) => own === "mean_power_w")].keys()].sort((a, b) => values[4][a] - values[4][b]);
    const order = () => page.locator("#rows tbody tr").evaluateAll((rows) => rows.map((row) => Number(row.dataset.row)));
    await name.click();
    assert.deepEqual(await order(), due);
    await name.click();
    assert.deepEqual(await order(), due.reverse());
});

test("the origin holds command and files", async () => {
    await page.locator("#origin summary").click();
    const text = await page.locator("#origin").textContent();
    assert.ok(text.includes("jounce study run study.toml --out FOLDER") && text.includes("[vary]") && text.includes("[stop.tip]"), text);
});

test("no serious issue of axe in light and dark, and paper is light", async () => {
    for (const look of ["light", "dark"]) {
        if ((await page.evaluate(() => document.documentElement.dataset.theme)) !== look) await page.locator("#theme").click();
        await page.evaluate(await readFile(axeSource, "utf8"));
        const found = await page.evaluate(() => window.axe.run());
        const serious = found.violations.filter((violation) => ["serious", "critical"].includes(violation.impact));
        assert.deepEqual(serious.map((violation) => [violation.id, violation.nodes.map((node) => node.html)]), []);
    }
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
    assert.equal(await page.locator("#chart .printed svg").count(), 1);
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    assert.equal(await page.locator("#chart .printed").count(), 0);
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    assert.deepEqual(page.faults, []);
});
