// Measured points over the response: files that are chosen or dropped on it. They are read in the page and kept for the tab; the server never gets them.

import type { Curve } from "./paint";
import { QUANTITIES } from "./branches";
import { type Series, measuredSeries, tableOf } from "./measured-table";
import type { Response } from "./response";
import { tabStorage } from "./storage";
import { colour } from "./theme";

const STORE = `jounce-measured ${location.pathname}`;
/** Largest file, and largest number of series. */
const MOST_BYTES = 4 << 20;
const MOST_SERIES = 6;
const COLOURS = ["ink", "vermilion", "purple", "green", "orange", "sky"];
const TABLE = /\.(csv|tsv|txt)$/i;

interface Item {
    file: string;
    series: Series;
    /** Number of its colour, which it retains. */
    colour: number;
}

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Measured {
    private kept: Item[] = JSON.parse(tabStorage?.getItem(STORE) ?? "[]") as Item[];
    private readonly host = find("measured");
    private readonly words = find("measured-words");

    constructor(private readonly response: Response) {
        const chosen = find<HTMLInputElement>("measured-file");
        find("measured-choose").onclick = () => chosen.click();
        chosen.onchange = () => {
            const file = chosen.files?.[0];
            if (file) void this.read(file);
            // The same file can be chosen again after it was changed.
            chosen.value = "";
        };
        this.show();
    }

    /** Reads a file that was dropped on the response, unless it is a recording: one with a column of times. Returns whether it was read. */
    async dropped(file: File): Promise<boolean> {
        if (!TABLE.test(file.name)) return false;
        if (file.size <= MOST_BYTES && tableOf(await file.text()).columns.some(({ unit }) => unit?.kind === "time")) return false;
        await this.read(file);
        return true;
    }

    private async read(file: File): Promise<void> {
        if (file.size > MOST_BYTES) return this.say(`${file.name}: larger than ${MOST_BYTES >> 20} MiB; the page shows tables of measured points, not recordings`);
        const found = measuredSeries(tableOf(await file.text()));
        if (typeof found === "string") return this.say(`${file.name}: ${found}`);
        // A file that is read again replaces its points.
        const others = this.kept.filter((own) => own.file !== file.name);
        if (others.length + found.length > MOST_SERIES) return this.say(`${file.name}: at most ${MOST_SERIES} columns are shown; remove others first`);
        this.kept = others;
        for (const series of found) {
            const free = COLOURS.findIndex((_, k) => this.kept.every((own) => own.colour !== k));
            this.kept.push({ file: file.name, series, colour: free });
        }
        this.say("");
        this.show();
    }

    private say(words: string): void {
        this.words.textContent = words;
        this.words.hidden = words === "";
    }

    private show(): void {
        try {
            tabStorage?.setItem(STORE, JSON.stringify(this.kept));
        } catch {
            this.say("The browser does not keep so many points: they are gone after the page is loaded again.");
        }
        this.response.measured = this.kept.map((own) => ({ ...own.series, colour: COLOURS[own.colour] }));
        this.host.replaceChildren(...this.kept.map((own) => this.item(own)));
        this.mark();
        this.response.draw();
    }

    /** Shows which points are on the chart: those of the quantity that it shows, over a frequency. */
    mark(): void {
        const { result, quantity, range } = this.response;
        [...this.host.children].forEach((item, k) => {
            const { series } = this.kept[k];
            const count = series.hertz.filter((hertz) => hertz >= range[0] && hertz <= range[1]).length;
            const points = `${series.hertz.length} ${series.hertz.length === 1 ? "point" : "points"}`;
            const isOther = series.quantity !== quantity;
            const isOver = result === undefined || result.unit === "Hz";
            item.classList.toggle("stale", isOther || !isOver);
            item.querySelector("output")!.textContent = !isOver ? `${points}, over a frequency` : isOther ? `${points}, under “${QUANTITIES[series.quantity].words}”` : count < series.hertz.length ? `${points}, ${count} in the range` : points;
        });
    }

    private item(own: Item): HTMLElement {
        const item = document.createElement("li");
        item.style.setProperty("--own", colour(COLOURS[own.colour]));
        const [words, points, remove] = [document.createElement("span"), document.createElement("output"), document.createElement("button")];
        words.textContent = `+ ${own.file}: ${own.series.words}, `;
        remove.textContent = "×";
        remove.setAttribute("aria-label", `Remove ${own.series.words} of ${own.file}`);
        remove.onclick = () => {
            this.kept = this.kept.filter((other) => other !== own);
            this.show();
        };
        item.append(words, points, remove);
        return item;
    }
}

/** Measured points of a quantity as they are drawn. */
export function measuredCurves(measured: MeasuredPoints[], quantity: string, unit: string): Curve[] {
    const own = unit === "Hz" ? measured.filter((series) => series.quantity === quantity) : [];
    return own.map(({ hertz, values, colour: name }) => ({ x: hertz, y: values, colour: colour(name), shape: "plus" }));
}

export type MeasuredPoints = Series & { colour: string };
