// Runs the tests in the browser, or says why it cannot.
import { spawnSync } from "node:child_process";
import { browserPath, program } from "./browser.mjs";

/** Far more than the tests take, also on a busy machine: one that hangs ends all the same. */
const LONGEST_MS = 1_800_000;

const missing = [
    program ? "" : "the program: run `cargo build --release --workspace` first",
    browserPath ? "" : "Chromium: install the package chromium, or name a browser in CHROMIUM",
].filter(Boolean);
if (missing.length > 0) {
    console.error(`the page cannot be tested in a browser; missing is ${missing.join("; ")}`);
    process.exit(1);
}
/** Those that run without `--all`: the first picture, and the most used controls and tabs. They take a minute. */
const SHORT = ["page", "first-picture", "explore"];
const LONG = ["axes", "wire", "draft-error", "charts", "budget", "cursor", "measured", "quantities", "range", "order", "draft", "drawn-designs", "keyboard", "axe", "truth", "use", "noise", "views", "limits", "labels", "design", "plate", "link", "print", "study"];

const began = performance.now();
const all = process.argv.includes("--all");
const tests = [...SHORT, ...(all ? LONG : [])].map((name) => new URL(`${name}.test.mjs`, import.meta.url).pathname);
const { status } = spawnSync(process.execPath, ["--test", "--test-concurrency=1", ...tests], { stdio: "inherit", timeout: LONGEST_MS });
if (!all) console.log(`SKIPPED long: ${LONG.length} files of tests of the live page`);
console.log(`page in a browser: ${((performance.now() - began) / 1000).toFixed(0)} s`);
if (status === null) console.error(`the tests of the page took longer than ${LONGEST_MS / 1000} s`);
process.exit(status ?? 1);
