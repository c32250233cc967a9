// What other programs read in a PDF: those of poppler.
import { spawnSync } from "node:child_process";

const call = (name, ...options) => {
    const { status, stdout, stderr, error } = spawnSync(name, options, { encoding: "utf8" });
    if (error || status !== 0) throw error ?? new Error(`${name}: ${stderr}`);
    return stdout;
};

/** Reason to skip a test without poppler. */
export const missing = spawnSync("pdftotext", ["-v"]).error ? "pdftotext is missing: install poppler-utils" : false;

/** Lines of a table after its head. */
const rows = (text) => text.trimEnd().split("\n").slice(2);

/** Number of images, names of the fonts that are not inside, number of those inside, and the text of a PDF file. */
export function read(path) {
    const fonts = rows(call("pdffonts", path)).map((row) => ({ name: row.slice(0, 36).trim(), inside: / yes yes yes +\d+ +\d+$/.test(row) }));
    return {
        images: rows(call("pdfimages", "-list", path)).length,
        outside: fonts.filter(({ inside }) => !inside).map(({ name }) => name),
        inside: fonts.filter(({ inside }) => inside).length,
        text: call("pdftotext", "-layout", path, "-"),
    };
}

/** Heights of the letters of a word wherever a PDF file has it, points. */
export function heights(path, word) {
    const found = call("pdftotext", "-bbox", path, "-").matchAll(/yMin="([\d.]+)" xMax="[\d.]+" yMax="([\d.]+)">([^<]*)</g);
    return [...found].filter(([, , , own]) => own === word).map(([, top, low]) => low - top);
}

/** Writes the first page as `STEM.png` with a number of pixels per inch. */
export function render(path, stem, resolution) {
    call("pdftoppm", "-png", "-singlefile", "-r", String(resolution), path, stem);
}

/** Share of pixels of which two pictures, as data addresses, differ visibly, and the share that is not nearly white. */
export function compare(page, first, second) {
    return page.evaluate(async (addresses) => {
        const pictures = await Promise.all(addresses.map(async (address) => {
            const picture = new Image();
            picture.src = address;
            await picture.decode();
            return picture;
        }));
        // Renderers differ in the edges of letters and lines: pixels are means of four by four.
        const [width, height] = [pictures[0].naturalWidth, pictures[0].naturalHeight].map((length) => Math.round(length / 4));
        const [one, two] = pictures.map((picture) => {
            const sheet = Object.assign(document.createElement("canvas"), { width, height });
            const ctx = sheet.getContext("2d");
            ctx.fillStyle = "white";
            ctx.fillRect(0, 0, width, height);
            ctx.imageSmoothingQuality = "high";
            ctx.drawImage(picture, 0, 0, width, height);
            return ctx.getImageData(0, 0, width, height).data;
        });
        let [different, inked] = [0, 0];
        for (let k = 0; k < one.length; k += 4) {
            const far = [0, 1, 2].map((part) => Math.abs(one[k + part] - two[k + part]));
            if (Math.max(...far) > 96) different++;
            if (Math.min(one[k], one[k + 1], one[k + 2]) < 200) inked++;
        }
        return { different: different / (width * height), inked: inked / (width * height), sizes: pictures.map((own) => [own.naturalWidth, own.naturalHeight]) };
    }, [first, second]);
}
