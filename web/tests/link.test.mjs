// A link that is copied on one machine opens the same page on another, which has only the program.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { open, ready, serve } from "./browser.mjs";
import { browser, page, server, type } from "./suite.mjs";

let elsewhere;
after(() => elsewhere?.close());

/** Text of the result. */
const result = (own) => own.locator("#readout").textContent();

test("the copied link opens spec, changes and axis elsewhere", async () => {
    await type("stop.tip.gap", "0.7 mm");
    await ready(page);
    await page.locator("#from").fill("10.5");
    await page.locator("#from").press("Enter");
    await page.locator("#to").fill("13.5");
    await page.locator("#to").press("Enter");
    await ready(page);
    await browser.context.grantPermissions(["clipboard-read", "clipboard-write"]);
    await page.locator("#share").click();
    await page.waitForFunction(() => /link was copied/.test(document.getElementById("reply").textContent));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    assert.match(link, /^jounce:\?set=/);
    // The colleague gets no access to this server.
    const [, token] = new URL(server.address).pathname.split("/");
    assert.ok(!link.includes(token) && !link.includes("127.0.0.1"), link);
    const readout = await result(page);

    elsewhere = await serve({ link });
    const other = await open(browser.context, elsewhere.address);
    assert.equal(await other.getByLabel("stop.tip.gap, value", { exact: true }).inputValue(), "0.7");
    assert.deepEqual([await other.locator("#from").inputValue(), await other.locator("#to").inputValue()], ["10.5", "13.5"]);
    assert.equal(await result(other), readout);
    assert.match(await other.locator("#close").textContent(), /gap 0\.7 mm/);
    assert.deepEqual(other.faults, []);
    await other.close();
});

test("the export shows the command that opens the link", async () => {
    await page.locator("#export").click();
    await page.locator("#export-dialog").waitFor({ state: "visible" });
    assert.match(await page.locator("#export-link").textContent(), /^jounce explore --link 'jounce:\?set=[^' ]+'$/);
    const command = await page.locator("#export-link").textContent();
    for (const [id, due] of [["link", command.match(/'(.*)'/)[1]], ["command", command]]) {
        await page.locator(`#export-copy-${id}`).click();
        await page.waitForFunction(() => document.getElementById("export-copied").textContent === "copied");
        await page.waitForFunction(async (text) => (await navigator.clipboard.readText()) === text, due);
    }
    await page.keyboard.press("Escape");
});

/** Fields of the fragment of a page, once its address is updated. */
const fragment = async (own) => {
    await own.waitForTimeout(400);
    return Object.fromEntries(new URLSearchParams(new URL(own.url()).hash.slice(1)));
};

test("the copied link opens the same view: tab, quantity, toggles, zoom, orbit and plane of the basins", async () => {
    await page.locator("#quantity").selectOption("penetration");
    for (const id of ["grazings", "long-periods"]) await page.locator(`#${id}`).check();
    await page.locator("#log").uncheck();
    await ready(page);
    await page.locator("#chart-response").focus();
    for (let k = 0; k < 4; k++) await page.keyboard.press("PageDown");
    for (let k = 0; k < 3; k++) await page.keyboard.press("+");
    await ready(page);
    await page.locator("#tab-basins").click();
    await page.locator("#basins-starts").selectOption("225");
    await page.locator("#basins-velocity-from").fill("-300 mm/s");
    await page.locator("#basins-velocity-to").fill("0.4");
    await page.locator("#share").click();
    await page.waitForFunction(() => /link was copied/.test(document.getElementById("reply").textContent));
    const link = await page.evaluate(() => navigator.clipboard.readText());
    const other = await serve({ link });
    const copy = await open(browser.context, other.address);
    const [own, found] = [await fragment(page), await fragment(copy)];
    assert.deepEqual(found, own);
    assert.deepEqual(Object.keys(own).filter((name) => !["set", "over", "from", "to"].includes(name)), ["show", "log", "grazings", "long_periods", "starts", "velocity", "tab", "zoom", "orbit"]);
    assert.equal(await copy.locator("#tab-basins").getAttribute("aria-selected"), "true");
    assert.equal(await copy.locator("#quantity").inputValue(), "penetration");
    const shown = (from) => Promise.all([from.locator("#orbit-title").textContent(), from.locator("#readout").textContent(), from.locator("#basins-velocity-from").inputValue()]);
    assert.deepEqual(await shown(copy), await shown(page));
    await copy.locator("#tab-response").click();
    assert.ok(await copy.locator("#zoom-out").isVisible());
    // The address has the same view after the page is loaded again.
    await copy.reload();
    await ready(copy);
    assert.deepEqual({ ...(await fragment(copy)), tab: "basins" }, own);
    assert.deepEqual(copy.faults, []);
    await copy.close();
    await other.close();
});

test("the orbit of a bifurcation is that of the link", async () => {
    await page.locator("#tab-response").click();
    await page.locator("#bifurcations-title").click();
    await page.locator("#bifurcations button", { hasText: /^fold$/ }).first().click();
    await page.waitForFunction(() => /stability limit/.test(document.getElementById("orbit-title").textContent));
    const copy = await open(browser.context, `${server.address}#${new URLSearchParams(await fragment(page))}`);
    assert.match((await fragment(copy)).orbit, /:fold$/);
    assert.equal(await copy.locator("#orbit-title").textContent(), await page.locator("#orbit-title").textContent());
    await copy.close();
});

test("values that a link cannot have are named, and the rest of it is shown; a link without them has the defaults", async () => {
    const fields = { set: "stop.tip.gap=0.8 mm", over: "drive.shaker.frequency", from: 12, to: 13, tab: "colours", show: "colour", log: "perhaps", long_periods: "yes", zoom: "1:2", orbit: "12.5:1:7e-3:0:1", starts: "7" };
    const copy = await open(browser.context, `${server.address}#${new URLSearchParams(fields)}`);
    await copy.waitForFunction(() => /orbit "12\.5:1:7e-3:0:1"/.test(document.getElementById("faults").textContent));
    const faults = await copy.locator("#faults").textContent();
    for (const words of [/tab "colours"/, /shows "colour"/, /log = "perhaps"/, /magnifies "1:2"/, /has 7 starts/]) assert.match(faults, words);
    assert.equal(await copy.getByLabel("stop.tip.gap, value", { exact: true }).inputValue(), "0.8");
    assert.ok(await copy.locator("#long-periods").isChecked());
    // A link of a design alone, pasted into the address of the open page.
    await copy.evaluate(() => (location.hash = "#set=stop.tip.gap%3D0.9+mm&over=drive.shaker.frequency&from=12&to=13"));
    await copy.waitForFunction(() => document.getElementById("faults").textContent === "" && document.getElementById("long-periods").checked);
    await ready(copy);
    assert.equal(await copy.getByLabel("stop.tip.gap, value", { exact: true }).inputValue(), "0.9");
    await copy.evaluate(() => (location.hash = "#tab=load"));
    await copy.waitForFunction(() => document.getElementById("tab-load").ariaSelected === "true");
    assert.equal(await copy.getByLabel("stop.tip.gap, value", { exact: true }).inputValue(), "0.9");
    assert.ok(!(await copy.locator("#long-periods").isChecked()));
    await copy.close();
});

test("the ring is only where the server recognises the motion of the operating point", async () => {
    // No branch has the orbit, as far as the server says.
    const hidden = () => {
        const without = (data) => {
            const length = new DataView(data).getUint32(0, true);
            const text = new TextDecoder().decode(new Uint8Array(data, 4, length));
            const head = JSON.parse(text);
            if (head.ask !== "branch-points") return data;
            window.recognised = head.places;
            const words = new TextEncoder().encode(JSON.stringify({ ...head, places: [null, null] }).padEnd(length));
            new Uint8Array(data, 4, length).set(words.slice(0, length));
            return data;
        };
        const Real = window.WebSocket;
        window.WebSocket = class extends Real {
            set onmessage(hear) {
                super.onmessage = ({ data }) => hear({ data: without(data) });
            }
        };
    };
    const copy = await open(browser.context, server.address, hidden);
    await copy.waitForFunction(() => window.recognised?.[0] && /of 100 starts/.test(document.getElementById("operating-words").textContent));
    await ready(copy);
    assert.equal(await copy.locator("#chart-response").getAttribute("aria-valuetext"), "no point selected");
    assert.match(await copy.locator("#orbit-title").textContent(), /^Orbit at 13 Hz: .*, stable/);
    await copy.close();
    const own = await open(browser.context, server.address);
    await own.waitForFunction(() => /of 100 starts/.test(document.getElementById("operating-words").textContent));
    await ready(own);
    assert.match(await own.locator("#chart-response").getAttribute("aria-valuetext"), /Hz, .*W, period 1, stable/);
    await own.close();
});
