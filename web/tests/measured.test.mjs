// Measured points over the response: read in the page, drawn with a legend, faults in plain words, kept for the tab.
import assert from "node:assert/strict";
import { beforeEach, test } from "node:test";
import { ready } from "./browser.mjs";
import { page, until } from "./suite.mjs";

const choose = (name, text) => page.locator("#measured-file").setInputFiles({ name, mimeType: "text/csv", buffer: Buffer.from(text) });
const items = () => page.locator("#measured li").allTextContents().then((list) => list.map((own) => own.replace("×", "")));
/** Waits until the list has these items: a file is read after its choice. */
const shows = async (due) => {
    for (let k = 0; k < 100 && JSON.stringify(await items()) !== JSON.stringify(due); k++) await page.waitForTimeout(50);
    assert.deepEqual(await items(), due);
};
const remove = async () => {
    while ((await page.locator("#measured li").count()) > 0) await page.locator("#measured li button").first().click();
};
beforeEach(remove);

/** Drops a file on an element. */
const drop = (selector, name, text) => page.evaluate(([at, file, content]) => {
    const data = new DataTransfer();
    data.items.add(new File([content], file));
    document.querySelector(at).dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
}, [selector, name, text]);
/** Rows of a column of the response with dark pixels, as those of the first measured points, and with the blue of the first branch; CSS pixels of the canvas. */
const rows = (x) => page.locator("#chart-response canvas").evaluate((canvas, at) => {
    const box = canvas.getBoundingClientRect();
    const ratio = canvas.width / box.width;
    // Above the numbers of the axis.
    const height = Math.floor((document.querySelector("#chart-response .u-over").getBoundingClientRect().bottom - box.top) * ratio);
    const { data } = canvas.getContext("2d").getImageData(Math.round(at * ratio), 0, 1, height);
    const where = (is) => Array.from({ length: height }, (_, k) => k).filter((k) => data[4 * k + 3] > 200 && is(data[4 * k], data[4 * k + 1], data[4 * k + 2])).map((k) => k / ratio);
    return { dark: where((r, g, b) => r < 60 && g < 60 && b < 60), blue: where((r, g, b) => r < 20 && Math.abs(g - 114) < 20 && Math.abs(b - 178) < 20) };
}, x);
const place = async (hertz) => {
    const [over, canvas] = [await page.locator("#chart-response .u-over").boundingBox(), await page.locator("#chart-response canvas").boundingBox()];
    return over.x - canvas.x + (over.width * (hertz - 11.44)) / (14.82 - 11.44);
};

test("points of a chosen file stand at their frequency and power, in the units of the header, and nothing is sent", async () => {
    const sent = [];
    await page.evaluate(() => {
        const send = WebSocket.prototype.send;
        window.sentFrames = [];
        WebSocket.prototype.send = function (data) {
            window.sentFrames.push(String(data));
            return send.call(this, data);
        };
    });
    page.on("request", (request) => sent.push(request.url()));
    // A computed point, as the page reads it.
    const x = await place(13.6);
    const canvas = await page.locator("#chart-response canvas").boundingBox();
    const { blue: before, dark } = await rows(x);
    assert.deepEqual(dark, []);
    await page.mouse.move(canvas.x + x, canvas.y + before[0]);
    const [, hertz, watt, prefix] = (await page.locator("#response-cursor").textContent()).match(/^([\d.]+) Hz, ([\d.]+) (µ|m)W/);
    await page.mouse.move(5, 5);
    const milliwatt = Number(watt) * (prefix === "m" ? 1 : 1e-3);
    await choose("bench.csv", `# shaker, 12 May\nfrequency in kHz,Power (mW),note\n${Number(hertz) / 1000},${milliwatt},a\n0.0125,,b\n0.02,1,c\n`);
    await shows(["+ bench.csv: Power (mW), 2 points, 1 in the range"]);
    assert.ok(await page.locator("#measured-words").isHidden());
    // A plus of 9 pixels about the curve, whose height is the mean of those beside the plus.
    const at = await place(Number(hertz));
    const [{ dark: plus }, left, right] = [await rows(at), await rows(at - 9), await rows(at + 9)];
    const [middle, due] = [(plus[0] + plus.at(-1)) / 2, (left.blue[0] + left.blue.at(-1) + right.blue[0] + right.blue.at(-1)) / 4];
    assert.ok(plus.at(-1) - plus[0] >= 7 && plus.at(-1) - plus[0] <= 10 && Math.abs(middle - due) < 1.6, `${plus} ${due}`);
    await page.waitForTimeout(300);
    assert.deepEqual([sent, await page.evaluate(() => window.sentFrames.filter((own) => own.includes("bench")))], [[], []]);
    await remove();
    assert.deepEqual((await rows(at)).dark, []);
});

test("a voltage and a displacement are drawn under their quantity, and points over a frequency not over another key", async () => {
    await choose("rig.tsv", "frequency_hz\tvoltage_rms_v\tTip displacement, peak to peak (mm)\n12\t10\t20\n14\t2\t3\n");
    await shows(["+ rig.tsv: voltage_rms_v, 2 points, under “Voltage, rms”", "+ rig.tsv: Tip displacement, peak to peak (mm), 2 points, under “Amplitude at the stop”"]);
    await page.locator("#quantity").selectOption("voltage");
    assert.match((await items())[0], /2 points$/);
    await page.locator("#quantity").selectOption("displacement");
    assert.match((await items())[1], /2 points$/);
    await page.locator("#over").selectOption("stop.tip.gap");
    await ready(page);
    assert.match((await items())[1], /2 points, over a frequency$/);
    await page.locator("#over").selectOption("drive.shaker.frequency");
    await page.locator("#quantity").selectOption("power");
    await ready(page);
    await remove();
});

test("points are kept for the tab, and a file that is read again replaces them", async () => {
    await choose("a.csv", "f (Hz);P (µW)\n12,5;1,5\n13;2\n");
    await page.reload();
    await ready(page);
    await shows(["+ a.csv: P (µW), 2 points"]);
    await choose("a.csv", "f (Hz);P (µW)\n12,5;1,5\n13;2\n14;3\n");
    await shows(["+ a.csv: P (µW), 3 points"]);
    await page.getByLabel("Remove P (µW) of a.csv").click();
    await page.reload();
    await ready(page);
    await shows([]);
});

test("a fault of a file is told in plain words, and its points are not drawn", async () => {
    const cases = [
        ["12,1\n13,2\n", /^x\.csv: the first line must name the columns with their units, such as frequency \(Hz\), power \(µW\)$/],
        ["drive,power (W)\n12,1\n", /no column has a unit of frequency/],
        ["f (Hz),g (Hz),power (W)\n12,1,1\n", /two columns are frequencies, “f \(Hz\)” and “g \(Hz\)”; keep one/],
        ["f (Hz),power\n12,1\n", /no column is a power, voltage or displacement/],
        ["f (Hz),power (W)\n12,1\n13,abc\n", /line 3, column “power \(W\)”: “abc” is not a number/],
        ["f (Hz),power (W)\n12,1,7\n", /line 2 has 3 values, the first line 2 columns/],
        ["f (Hz),voltage peak (V)\n12,1\n", /the response shows the rms of the voltage/],
        ["f (Hz),displacement rms (m)\n12,1\n", /the response shows the amplitude, half peak to peak/],
        ["f (Hz),power (W)\n12,\n", /no point with a frequency and a value/],
        ["", /the first line must name the columns/],
        ["\u0000\u0001\u0002", /no column has a unit of frequency/],
    ];
    for (const [text, due] of cases) {
        await choose("x.csv", text);
        await until("measured-words", due);
        assert.deepEqual(await items(), [], text);
    }
    await choose("x.csv", "f (Hz),power (W)\n12,1\n");
    await page.locator("#measured-words").waitFor({ state: "hidden" });
    await remove();
});

test("with measured points and at any size, the chart keeps its height and covers no text", async () => {
    await choose("a.csv", "f (Hz),power (µW),voltage (V)\n12,100,3\n13,90,2\n");
    for (const [width, height, least] of [[1280, 720, 150], [820, 1000, 230], [390, 844, 230]]) {
        await page.setViewportSize({ width, height });
        await ready(page);
        const [chart, below] = [await page.locator("#chart-response").boundingBox(), await page.locator("#panel-response > .readout").boundingBox()];
        const buttons = await page.locator("#measured-choose").boundingBox();
        assert.ok(buttons.y + buttons.height <= chart.y + 0.5 && chart.height >= least && chart.y + chart.height <= below.y + 0.5, JSON.stringify([width, chart, below]));
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await ready(page);
});

test("a table that is dropped on the response is drawn; a recording, or a table beside it, excites the harvester", async () => {
    await drop("#chart-response .u-over", "points.csv", "frequency (Hz),power (mW)\n12,1\n");
    await page.locator("#measured li").waitFor();
    assert.equal(await page.getAttribute("#tab-response", "aria-selected"), "true");
    await remove();
    const sine = Array.from({ length: 2000 }, (_, k) => `${k / 500},${Math.sin(0.16 * k)}`).join("\n");
    await drop("#chart-response .u-over", "shaker.csv", `time (s),force\n${sine}\n`);
    await until("shake-words", /shaker\.csv/);
    await shows([]);
    await page.locator("#tab-response").click();
    await ready(page);
});

test("no error was printed in the browser", () => assert.deepEqual(page.faults, []));
