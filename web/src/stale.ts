// Marks of results that belong to an earlier design.

import type { Design } from "./design";
import type { Request } from "./wire";

export class Stale {
    private of: string | undefined;

    constructor(private readonly panel: HTMLElement, private readonly words: HTMLElement, private readonly design: Design) {}

    /** True where the result belongs to an earlier design. */
    get isOld(): boolean {
        return this.of !== undefined && this.of !== this.design.signature;
    }

    /** Registers that the result of a request is shown. */
    shows(request: Request): void {
        this.of = request.design;
        this.mark();
    }

    /** Shows whether the result belongs to the present design. */
    mark(): void {
        this.panel.classList.toggle("stale", this.isOld);
        this.words.hidden = !this.isOld;
    }
}
