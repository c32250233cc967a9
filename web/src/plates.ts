// Plates in slow motion: the displacement at instants of the period, as contours with nodal lines.

import type { Frame } from "./frame";
import { put } from "./picture";
import { quantity } from "./units";

interface Plate {
    name: string;
    /** Largest displacement, m; that of the first and the last colour. */
    largest: number;
    pictures: string[];
}

export class Plates {
    private plates: Plate[] = [];
    private readonly hosts: HTMLElement[] = [];
    private shown = -1;

    constructor(private readonly host: HTMLElement) {}

    take(frame: Frame): void {
        this.plates = frame.head.plates as Plate[];
        this.host.hidden = this.plates.length === 0;
        this.hosts.splice(0);
        const parts = this.plates.map(({ name, largest }) => {
            const [part, words, picture] = ["figure", "figcaption", "div"].map((kind) => document.createElement(kind));
            const size = quantity(largest, "m");
            words.textContent = `${name}: displacement from -${size} (dark) to ${size} (light)`;
            part.append(words, picture);
            this.hosts.push(picture);
            return part;
        });
        this.host.replaceChildren(...parts);
        this.shown = -1;
    }

    /** Shows the instant that is nearest to a fraction of the period. */
    show(phase: number): void {
        const count = this.plates[0]?.pictures.length ?? 0;
        const instant = count && Math.round(phase * count) % count;
        if (count === 0 || instant === this.shown) return;
        this.shown = instant;
        this.plates.forEach(({ name, pictures }, k) => put(this.hosts[k], pictures[instant], `Displacement of ${name}`));
    }
}
