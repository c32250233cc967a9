// The socket of the page: one handler of the replies of each kind.
import assert from "node:assert/strict";
import { test } from "node:test";
import { build } from "esbuild";

test("a second handler of one kind of replies is an error", async () => {
    const { outputFiles: [{ text }] } = await build({ entryPoints: [new URL("../src/wire.ts", import.meta.url).pathname], bundle: true, format: "esm", write: false });
    const { Wire } = await import(`data:text/javascript,${encodeURIComponent(text)}`);
    const wire = new Wire({});
    wire.on("orbit", () => {});
    wire.on("sweep", () => {});
    assert.throws(() => wire.on("orbit", () => {}), /the replies to orbit have a handler/);
});
