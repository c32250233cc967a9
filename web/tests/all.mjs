// Runs the tests in the browser, or says why it cannot.
import { spawnSync } from "node:child_process";
import { browserPath, program } from "./browser.mjs";

const missing = [
    program ? "" : "the program: run `cargo build --release` first",
    browserPath ? "" : "Chromium: install the package chromium, or name a browser in CHROMIUM",
].filter(Boolean);
if (missing.length > 0) {
    console.log(`SKIPPED the tests of the page in a browser; missing is ${missing.join("; ")}`);
    process.exit(0);
}
process.exit(spawnSync(process.execPath, ["--test", "--test-concurrency=1", new URL("page.test.mjs", import.meta.url).pathname], { stdio: "inherit" }).status ?? 1);
