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
    await page.waitForFunction(() => /link was copied/.test(document.getElementById("status").textContent));
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
