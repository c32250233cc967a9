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
/** Presses Enter on a control, once it can be used. */
export const enter = async (control) => {
    await control.click({ trial: true });
    await control.press("Enter");
};
export const until = (id, pattern, own = page) => own.waitForFunction(([name, source]) => new RegExp(source).test(document.getElementById(name).textContent), [id, pattern.source]);

/** Labels of the drawing that cover each other or leave their part of it. */
export const badLabels = (own) => own.evaluate(() => [...document.querySelectorAll("#drawing > div > svg")].flatMap((view) => {
    const box = view.getBoundingClientRect();
    const labels = [...view.querySelectorAll("text")].map((text) => ({ words: text.textContent, ...text.getBoundingClientRect().toJSON() }));
    const covers = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 1 && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 3;
    const pairs = labels.flatMap((a, k) => labels.slice(k + 1).filter((b) => covers(a, b)).map((b) => `${a.words} / ${b.words}`));
    const cut = labels.filter((own) => own.left < box.left - 1 || own.right > box.right + 1 || own.top < box.top - 1 || own.bottom > box.bottom + 1);
    return [...pairs, ...cut.map((own) => `cut: ${own.words}`)];
}));
