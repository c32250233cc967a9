// The page of a file of tests: served and opened before its tests, closed after them.
import { after, before } from "node:test";
import { browse, open, serve } from "./browser.mjs";

export let server;
export let browser;
export let page;

before(async () => {
    server = await serve();
    browser = await browse();
    page = await open(browser.context, server.address);
});
after(async () => {
    await browser?.close();
    await server?.close();
});

export const field = (key) => page.getByLabel(`${key}, value`, { exact: true });
export const type = async (key, value) => {
    await field(key).fill(value);
    await field(key).press("Enter");
};
export const until = (id, pattern, own = page) => own.waitForFunction(([name, source]) => new RegExp(source).test(document.getElementById(name).textContent), [id, pattern.source]);
