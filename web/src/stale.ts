// Marks of results that belong to an earlier design.

import type { Design } from "./design";

export class Stale {
    private of = "";
    private shown = false;

    constructor(private readonly panel: HTMLElement, private readonly words: HTMLElement, private readonly design: Design) {}

    /** True where the result belongs to an earlier design. */
    get isOld(): boolean {
        return this.shown && this.of !== this.design.signature;
    }

    /** Registers that a result of the present design is requested. */
    begin(): void {
        this.of = this.design.signature;
        this.shown = true;
        this.mark();
    }

    /** Shows whether the result belongs to the present design. */
    mark(): void {
        this.panel.classList.toggle("stale", this.isOld);
        this.words.hidden = !this.isOld;
    }
}
