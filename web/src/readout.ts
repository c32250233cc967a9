// Text and table below the response: peak and bandwidth, what the search may miss, bifurcations.

import type { Bifurcation, Draft } from "./branches";
import { distanceWords } from "./draft-error";
import type { Head } from "./frame";
import { digits, quantity, quantityWithError } from "./units";

export class Readout {
    private shown = "";
    private readonly draft = document.getElementById("draft-words")!;

    constructor(private readonly words: HTMLElement, private readonly note: HTMLElement, private readonly title: HTMLElement, private readonly rows: HTMLElement) {}

    /** Shows the text, the note of the search, the words about the last draft, and the bifurcations; `choose` is called with the one that is clicked. */
    show(text: string, note: string, draft: string, found: Bifurcation[], unit: string, choose: (found: Bifurcation) => void): void {
        if (this.words.textContent !== text) this.words.textContent = text;
        // The rest names options of the command line.
        this.note.textContent = sentence(note.replaceAll("`", "").split(";")[0]);
        this.note.hidden = note === "";
        this.draft.textContent = draft;
        this.draft.parentElement!.hidden = draft === "";
        this.title.parentElement!.hidden = found.length === 0;
        const own = JSON.stringify(found);
        if (own === this.shown) return;
        this.shown = own;
        this.title.textContent = `${found.length} ${found.length === 1 ? "bifurcation" : "bifurcations"}`;
        this.rows.replaceChildren(...[...found].sort((a, b) => a.x - b.x).map((one) => row(one, unit, choose)));
    }
}

/** A message of the program as a sentence. */
export const sentence = (words: string): string => words && `${words[0].toUpperCase()}${words.slice(1)}.`;

/** Shows words in an element; an option of the command line is not divided between lines. */
export function showOptions(host: HTMLElement, words: string): void {
    const part = (own: string, k: number) => (k % 2 === 1 ? Object.assign(document.createElement("code"), { textContent: own }) : own);
    host.replaceChildren(...words.split(/(--[a-z-]+)/).map(part));
}

function row(found: Bifurcation, unit: string, choose: (found: Bifurcation) => void): HTMLElement {
    const line = document.createElement("tr");
    const button = document.createElement("button");
    button.textContent = found.kind;
    button.title = "Show the orbit";
    button.onclick = () => choose(found);
    const cells = [button, quantityWithError(found.x, found.error, unit), quantity(found.power, "W")].map((content) => {
        const cell = document.createElement("td");
        cell.append(content);
        return cell;
    });
    line.replaceChildren(...cells);
    return line;
}

/** A sentence about how far a draft is to be trusted: the distance of its lines from the curves, and what it lacks. */
export function draftWords({ origin, lost_share, error }: Draft): string {
    if (origin === "first") return "Draft: without contact only, until the first orbits are found.";
    const from = origin === "updated" ? "" : " from a few orbits";
    const lines = error === null ? "no curve is known well enough to be drawn" : `lines within ${distanceWords(error)}`;
    const lost = lost_share >= 0.005 ? ` ${digits(100 * lost_share, 2)} % of the last searched curves is lost;` : "";
    return `Draft${from}: ${lines};${lost} curves may be missing until the search ends.`;
}

/** Sentences about the peak of the stable orbits and the half-power bandwidth. Where the peak or the band ends only with the range, they say so. */
export function peakWords(widths: Head | undefined, unit: string): string[] {
    if (!widths?.peak) return [];
    const at = (x: number) => quantity(x, unit, 5);
    const { peak, intervals, width } = widths;
    const power = quantity(peak.mean_power_w, "W");
    if (peak.at === "end") return [`Largest stable power in the range: ${power} at ${at(peak.parameter)}, where the branch or the range ends; no peak.`];
    const cut = (intervals as { from: { at: string }; to: { at: string } }[]).some(({ from, to }) => from.at === "end" || to.at === "end");
    return [`Peak ${power} at ${at(peak.parameter)}.`, `Half-power bandwidth ${cut ? "at least " : ""}${at(width)}${cut ? "; the range cuts it" : ""}.`];
}
