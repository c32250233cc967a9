// Bundles code and looks of the live page, and of the page of a study, into crates/jounce-explorer/page, where the program takes them from
// and where `index.html`, `study.html` and the icon stand as they are. The same sources give the same bytes.
// `node build.mjs --check` says whether what lies there is what the sources give.
import { build } from "esbuild";
import { readFile, writeFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";

const out = new URL("../crates/jounce-explorer/page/", import.meta.url);
const here = new URL("./", import.meta.url);
const result = await build({
    absWorkingDir: here.pathname,
    entryPoints: { app: "src/main.ts", style: "page/app.css", study: "src/study/main.ts", "study-style": "page/study.css" },
    bundle: true,
    minify: true,
    write: false,
    outdir: "out",
    format: "esm",
    target: ["es2022"],
    legalComments: "none",
    charset: "utf8",
});
const text = (ending) => result.outputFiles.find((file) => file.path.endsWith(ending)).text;
const licence = "/*! uPlot: MIT, Copyright (c) Leon Sorokin. The rest: MIT OR Apache-2.0, jounce. */\n";
const files = {
    "app.js": licence + text("app.js"),
    "app.css": text("/style.css"),
    "study.js": licence + text("study.js"),
    "study.css": text("study-style.css"),
};
/** Files that the live page loads. */
const live = ["app.js", "app.css"];
let stale = [];
let weight = 0;
for (const name of ["index.html", "icon.svg"]) weight += gzipSync(await readFile(new URL(name, out))).length;
for (const [name, content] of Object.entries(files)) {
    if (live.includes(name)) weight += gzipSync(content).length;
    const before = await readFile(new URL(name, out), "utf8").catch(() => "");
    if (before !== content) {
        stale.push(name);
        if (!process.argv.includes("--check")) await writeFile(new URL(name, out), content);
    }
}
console.log(`page: ${(weight / 1024).toFixed(1)} KiB compressed`);
if (process.argv.includes("--check") && stale.length > 0) {
    console.error(`crates/jounce-explorer/page is older than web/: ${stale.join(", ")}; run \`npm run build\` in web/`);
    process.exit(1);
}
