// Mode shapes along the beams, and over the plates as contours with nodal lines.

import type { Design } from "./design";
import type { Head } from "./frame";
import { put } from "./picture";
import { Stale } from "./stale";
import type { Request, Wire } from "./wire";

const find = (id: string) => document.getElementById(id)!;

export class Modes {
    private readonly panel = find("panel-modes");
    private readonly figures = find("mode-figures");
    private readonly words = find("modes-words");
    private readonly stale: Stale;

    constructor(private readonly wire: Wire, private readonly design: Design) {
        this.stale = new Stale(this.panel, find("modes-stale"), design);
        wire.on("modes", ({ head }, request) => this.take(head, request));
    }

    /** Requests the shapes of the present design. */
    run(): void {
        if (this.wire.ask("modes", { set: this.design.pairs }) === 0) return;
        this.panel.setAttribute("aria-busy", "true");
        if (this.figures.children.length === 0) this.words.textContent = "computing the modes";
    }

    /** Shows whether the shapes belong to the present design. */
    mark(): void {
        this.stale.mark();
    }

    /** Shapes that are visible follow the design. */
    designTaken(): void {
        if (!this.panel.hidden) this.run();
    }

    /** The lost connection has taken the computation with it. */
    forget(): void {
        this.panel.removeAttribute("aria-busy");
    }

    private take(head: Head, request: Request): void {
        this.panel.removeAttribute("aria-busy");
        if (head.stage === "fault") {
            this.words.textContent = head.faults[0]?.message ?? "";
            return;
        }
        this.stale.shows(request);
        const figures = head.figures as { name: string; svg: string }[];
        this.words.textContent = figures.length > 0 ? "Undamped modes, short circuit" : "This harvester is given by its modes: there is no beam and no plate to draw them on";
        const hosts = figures.map(({ name, svg }) => {
            const host = document.createElement("div");
            put(host, svg, `Mode shapes of ${name.replace("modes-", "")}`);
            return host;
        });
        this.figures.replaceChildren(...hosts);
    }
}
