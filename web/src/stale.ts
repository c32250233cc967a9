// Marks of results that belong to an earlier design, or to another choice of the fields next to them.

import type { Design } from "./design";
import type { Request } from "./wire";

export class Stale {
    private of: string | undefined;
    private chosen = "";

    /** `choice` is the text of the fields next to the result. */
    constructor(private readonly panel: HTMLElement, private readonly words: HTMLElement, private readonly design: Design, private readonly choice: () => string = () => "") {}

    /** True where the result belongs to an earlier design. */
    get isOld(): boolean {
        return this.of !== undefined && this.of !== this.design.signature;
    }

    /** True where the result belongs to another choice. */
    private get isOther(): boolean {
        return this.of !== undefined && this.chosen !== this.choice();
    }

    /** Registers that the result of a request is shown. */
    shows(request: Request, chosen = ""): void {
        [this.of, this.chosen] = [request.design, chosen];
        this.mark();
    }

    /** Shows whether the result belongs to the present design and choice. */
    mark(): void {
        this.panel.classList.toggle("stale", this.isOld || this.isOther);
        this.words.hidden = !this.isOld && !this.isOther;
        this.words.textContent = this.isOld ? "of an earlier design" : "of other starts";
    }
}
