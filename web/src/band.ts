// Band of the power under the tolerances, shaded on the response of the present design.

import type { Design } from "./design";
import type { Frame } from "./frame";
import type { Response } from "./response";
import type { FieldFault, Rows } from "./rows";
import type { Selection } from "./selection";
import type { Wire } from "./wire";

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Band {
    private readonly box = find<HTMLInputElement>("robust");
    private readonly words = find("robust-words");
    /** What was requested last: orbit and tolerances. */
    private requested = "";

    constructor(private readonly wire: Wire, private readonly design: Design, private readonly response: Response, private readonly selection: Selection, private readonly rows: Rows) {
        wire.on("band", (frame) => this.take(frame));
        this.box.onchange = () => this.follow();
        rows.list.addEventListener("change", () => this.follow());
    }

    /** Requests the band of a searched response at the operating point, where it is not known. */
    follow(): void {
        const { result } = this.response;
        const { operating: place } = this.selection;
        const isKnown = result !== undefined && result.draft === undefined && !this.response.isOld && place !== undefined;
        const wanted = this.box.checked && isKnown ? JSON.stringify([result.id, place, this.rows.pairs]) : "";
        if (wanted === this.requested) return;
        if (this.requested !== "") this.wire.stop("band");
        this.requested = wanted;
        this.response.band = undefined;
        this.words.textContent = "";
        this.response.draw();
        if (!isKnown || wanted === "") return;
        this.rows.tell([]);
        this.words.textContent = "drawing designs";
        this.wire.ask("band", { set: this.design.pairs, response: result.id, ...place, tolerance: this.rows.pairs });
    }

    /** The lost connection has taken the request with it. */
    forget(): void {
        this.requested = "";
        this.words.textContent = "";
    }

    private take(frame: Frame): void {
        const { head } = frame;
        if (head.stage === "progress") {
            this.words.textContent = `${head.done} of ${head.of} designs drawn`;
            return;
        }
        if (head.stage === "fault") {
            const rest = this.rows.tell(head.faults as FieldFault[]);
            this.words.textContent = rest.map(({ message }) => message).join(" ");
            return;
        }
        const [x, low, high, share] = ["x", "low", "high", "share"].map((name) => frame.array(name));
        this.words.textContent = `shaded: 5 % to 95 % of ${head.draws} drawn designs${share.some((own) => own < 1) ? "; paler, or not shaded, where some or all lose the orbit" : ""}`;
        this.response.band = { over: head.over, x, low, high, share };
        this.response.draw();
    }
}
