// A server on a copy of a spec, and a real browser on its page.
import { spawn, spawnSync } from "node:child_process";
import { cp, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { existsSync } from "node:fs";
import { createInterface } from "node:readline";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const root = new URL("../../", import.meta.url).pathname;
const programs = [process.env.JOUNCE, `${root}target/release/jounce`, `${root}target/debug/jounce`];
export const program = programs.find((path) => path && existsSync(path));
/** Folder of page files, after `npm run build`, that replace those in the program: the page is tested without a build of the program. */
const pageFolder = process.env.JOUNCE_PAGE;
const browsers = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
export const browserPath = browsers.find((path) => path && existsSync(path));
/** Far more than anything on the page takes, also on a busy machine. */
const LONGEST_MS = 120_000;

const FLAGS = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"];

/** Kinds of templates that `jounce new` writes. */
export const templates = () => spawnSync(program, ["new"], { encoding: "utf8" }).stdout.trim().split("\n").map((line) => line.split(" ")[0]);

/** A replaced page has no address, so Chromium would refuse its socket to this machine. */
const OPEN_NETWORK = "--disable-features=LocalNetworkAccessChecks";

/** Servers that run. They do not keep the tests from ending: one that a failed test has left open ends with them. */
const running = new Set();
process.on("exit", () => running.forEach((child) => child.kill("SIGKILL")));

/** Starts a server on a copy of the paper's spec, of another example, of the template of a kind, on a text, or on a link. */
export async function serve(options = {}) {
    const folder = await mkdtemp(join(tmpdir(), "explore-"));
    const spec = join(folder, "harvester.toml");
    if (options.text) await writeFile(spec, options.text);
    else if (options.kind) spawnSync(program, ["new", options.kind, "--out", spec], { stdio: "inherit" });
    else await cp(`${root}examples/${options.example ?? "impact-harvester-2019/harvester.toml"}`, spec);
    const begin = async (listen) => {
        const subject = options.link ? ["--link", options.link] : [spec];
        const child = spawn(program, ["explore", ...subject, "--no-browser", "--json", ...(listen ? ["--listen", listen] : [])], {
            cwd: folder, stdio: ["ignore", "pipe", "inherit"], env: { ...process.env, XDG_STATE_HOME: join(folder, "state") },
        });
        const line = await new Promise((resolve, reject) => {
            createInterface({ input: child.stdout }).once("line", resolve);
            child.once("exit", (code) => reject(new Error(`jounce explore ended with ${code}`)));
        });
        running.add(child);
        child.unref();
        child.stdout.unref();
        return { child, page: JSON.parse(line).page };
    };
    const first = await begin(options.listen);
    const end = (child) => new Promise((resolve) => {
        if (child.exitCode !== null) return resolve();
        running.delete(child);
        child.ref();
        child.once("exit", resolve);
        child.kill("SIGINT");
    });
    const server = {
        folder, spec, address: first.page, child: first.child,
        stop: () => end(server.child),
        start: async () => {
            const again = await begin(options.listen);
            server.child = again.child;
            return again.page;
        },
        close: async () => {
            await end(server.child);
            await rm(folder, { recursive: true, force: true });
        },
    };
    return server;
}

/** Answers a request with the file of the folder, under the headers of the program. A request that the program redirects is not replaced. */
async function replaced(route) {
    const response = await route.fetch();
    const name = new URL(route.request().url()).pathname.match(/[^/]*$/)[0] || "index.html";
    await route.fulfill({ response, body: await readFile(join(pageFolder, name)) });
}

/** A browser with a fresh profile. */
export async function browse() {
    const profile = await mkdtemp(join(tmpdir(), "profile-"));
    const context = await chromium.launchPersistentContext(profile, {
        executablePath: browserPath, headless: true, args: pageFolder ? [...FLAGS, OPEN_NETWORK] : FLAGS, viewport: { width: 1280, height: 800 }, acceptDownloads: true,
    });
    context.setDefaultTimeout(LONGEST_MS);
    if (pageFolder) await context.route(/\/(index\.html|app\.js|app\.css)?$/, replaced);
    return {
        context,
        close: async () => {
            await context.close();
            await rm(profile, { recursive: true, force: true }).catch(() => {});
        },
    };
}

/** Opens the page, with a script before its own, and waits for its first fine response and orbit. */
export async function open(context, address, script = () => {}) {
    const page = await context.newPage();
    page.faults = [];
    page.on("pageerror", (error) => page.faults.push(String(error)));
    page.on("console", (message) => message.type() === "error" && page.faults.push(message.text()));
    await page.addInitScript(script);
    await page.goto(address);
    await ready(page);
    return page;
}

/** Waits until the response is fine, its orbit is there, and nothing that was asked is still to come. */
export async function ready(page) {
    await page.waitForFunction(() => {
        const words = (id) => document.getElementById(id).textContent;
        return /branch/.test(document.getElementById("chart-response").ariaLabel) && /period/.test(words("orbit-title")) && !document.querySelector("[aria-busy=true]");
    });
}

/** Share of pixels of an element that are not its most frequent colour. */
export async function inked(page, selector) {
    return page.locator(selector).evaluate((canvas) => {
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let drawn = 0;
        for (let k = 3; k < data.length; k += 4) drawn += data[k] > 40 ? 1 : 0;
        return drawn / (data.length / 4);
    });
}
