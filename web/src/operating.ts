// The operating point: what the present design does at its own drive, from a cloud of starts and from the orbit there.

import type { Design } from "./design";
import type { Frame, Head } from "./frame";
import { quantity, digits } from "./units";
import type { Wire } from "./wire";

export interface Attractor {
    id: string;
    period_cycles: number;
    mean_power_w: number;
    fraction: number;
}

/** Number of starts of the cloud. */
const STARTS = 100;
/** Time without changes after which the attractors are requested. */
const REST_MS = 150;

export class OperatingPoint {
    /** The attractor that most starts reach; undefined until it is computed for the present design. */
    attractor: Attractor | undefined;
    private head: Head | undefined;
    private orbit: Head | undefined;
    private message = "";
    private periodic = false;
    private signature = "";
    private resting = 0;
    /** Called when the attractor of the present design is known, or no longer known. */
    onChange: () => void = () => {};

    constructor(private readonly wire: Wire, private readonly design: Design, private readonly words: HTMLElement, private readonly warnings: HTMLElement) {
        wire.on("operating-point", (frame) => this.take(frame));
    }

    /** Requests the attractors of a design once it rests; `hertz` is null without a periodic drive. */
    designTaken(hertz: number | null): void {
        this.periodic = hertz !== null;
        if (this.signature === this.design.signature) return;
        this.signature = this.design.signature;
        this.attractor = this.head = this.orbit = undefined;
        this.message = "";
        clearTimeout(this.resting);
        if (this.periodic) this.resting = setTimeout(() => this.wire.ask("operating-point", { set: this.design.pairs, starts: STARTS }), REST_MS);
        this.onChange();
        this.show();
    }

    /** The lost connection has taken the request with it. */
    forget(): void {
        this.signature = "";
    }

    private take(frame: Frame): void {
        const { head } = frame;
        if (head.stage === "fault") this.message = head.faults[0]?.message ?? "";
        else {
            this.head = head;
            this.attractor = (head.attractors as Attractor[]).reduce<Attractor | undefined>((most, own) => (most && most.fraction >= own.fraction ? most : own), undefined);
        }
        this.onChange();
        this.show();
    }

    /** Takes the orbit at the operating point, or nothing while another orbit is shown. */
    orbitTaken(head: Head | undefined): void {
        this.orbit = head;
        this.show();
    }

    /** Takes the result of an integration under the drives of a spec without a period. */
    runTaken(words: string): void {
        if (this.periodic) return;
        this.message = words;
        this.show();
    }

    private show(): void {
        const text = this.text();
        if (this.words.textContent !== text) this.words.textContent = text;
        this.words.ariaBusy = String(this.periodic && !this.head && !this.message);
        const warnings = ((this.orbit?.warnings ?? []) as string[]).join(". ");
        if (this.warnings.textContent !== warnings) this.warnings.textContent = warnings;
        this.warnings.hidden = warnings === "";
    }

    private text(): string {
        const { head, attractor } = this;
        if (this.message) return this.message;
        if (!this.periodic) return "The drives of this spec have no common period.";
        if (!head || !attractor) return "Operating point: integrating 100 starts";
        const share = (own: Attractor) => `${digits(100 * own.fraction, 3)} % of ${head.finished} starts`;
        const kind = (own: Attractor) => (own.period_cycles > 0 ? `period ${own.period_cycles}, stable` : own.id);
        const others = (head.attractors as Attractor[]).filter((own) => own !== attractor);
        const more = others.map((own) => `${quantity(own.mean_power_w, "W")}, ${kind(own)}, by ${share(own)}`);
        return [
            `At ${quantity(head.frequency_hz, "Hz", 5)}: ${quantity(attractor.mean_power_w, "W")}, ${kind(attractor)}, reached by ${share(attractor)}${this.limits()}`,
            ...(more.length > 0 ? [`also ${more.join("; ")}`] : []),
        ].join("; ");
    }

    /** The largest strain of the orbit with its limit. */
    private limits(): string {
        const found = ((this.orbit?.limits ?? []) as { quantity: string; reached: number; limits: [number, number] }[]).filter((own) => own.quantity === "strain");
        const strain = found.sort((a, b) => Math.abs(b.reached / b.limits[1]) - Math.abs(a.reached / a.limits[1]))[0];
        return strain ? `, strain ${digits(1e6 * Math.abs(strain.reached), 3)} ppm of ${digits(1e6 * strain.limits[1], 3)}` : "";
    }
}
