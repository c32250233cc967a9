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
    fraction_low: number;
    fraction_high: number;
}

interface Parts {
    words: HTMLElement;
    warnings: HTMLElement;
    stop: HTMLButtonElement;
}

/** Numbers of starts of the clouds: a first result from a small one, then from a large one. */
const STARTS = [10, 100];
/** Time without changes after which the attractors are requested. */
const REST_MS = 150;
/** Time without a first result after which the page shows a run from the start of the spec. */
const SLOW_MS = 800;

export class OperatingPoint {
    /** The attractor that most starts reach; undefined until it is computed for the present design. */
    attractor: Attractor | undefined;
    private head: Head | undefined;
    private orbit: Head | undefined;
    private message = "";
    /** Result of a run from the start of the spec, until the attractors are known. */
    private run = "";
    private progress = "";
    private computing = false;
    private slow = false;
    /** Undefined until the first design. */
    private periodic: boolean | undefined;
    private signature = "";
    private requested = "";
    private timers: number[] = [];
    /** Called when the attractor of the present design is known, or no longer known. */
    onChange: () => void = () => {};
    /** Called where no attractor is known after a while. */
    onSlow: () => void = () => {};

    constructor(private readonly wire: Wire, private readonly design: Design, private readonly parts: Parts) {
        wire.on("operating-point", (frame) => this.take(frame));
        parts.stop.onclick = () => this.stop();
    }

    /** Clears what belongs to an earlier design. */
    mark(): void {
        if (this.signature === this.design.signature) return;
        this.signature = this.design.signature;
        this.requested = "";
        this.wire.stop("operating-point");
        for (const timer of this.timers) clearTimeout(timer);
        this.attractor = this.head = this.orbit = undefined;
        this.message = this.run = this.progress = "";
        this.slow = this.computing = false;
        this.show();
    }

    /** Requests the attractors of the present design once it rests; `hertz` is null without a periodic drive. */
    designTaken(hertz: number | null): void {
        this.periodic = hertz !== null;
        if (this.requested === this.design.signature) return;
        this.requested = this.design.signature;
        this.computing = this.periodic;
        this.timers = this.periodic ? [setTimeout(() => this.ask(STARTS[0]), REST_MS), setTimeout(() => this.late(), REST_MS + SLOW_MS)] : [];
        this.onChange();
        this.show();
    }

    private late(): void {
        this.slow = true;
        if (!this.head && this.computing) this.onSlow();
        this.show();
    }

    private ask(starts: number): void {
        this.wire.ask("operating-point", { set: this.design.pairs, starts });
    }

    private stop(): void {
        this.wire.stop("operating-point");
        this.computing = false;
        this.progress = "";
        if (!this.head) this.message = ["Operating point: stopped", this.run].filter(Boolean).join(". ");
        this.show();
    }

    /** The lost connection has taken the request with it. */
    forget(): void {
        this.requested = "";
        this.computing = false;
        this.show();
    }

    private take(frame: Frame): void {
        const { head } = frame;
        if (head.stage === "progress") {
            this.progress = `${head.done} of ${head.of} starts integrated`;
            return this.show();
        }
        this.progress = "";
        const more = head.stage === "fault" ? undefined : STARTS.find((starts) => starts > head.starts);
        this.computing = more !== undefined;
        if (head.stage === "fault") this.message = head.faults[0]?.message ?? "";
        else {
            this.head = head;
            this.attractor = (head.attractors as Attractor[]).reduce<Attractor | undefined>((most, own) => (most && most.fraction >= own.fraction ? most : own), undefined);
        }
        if (more !== undefined) this.ask(more);
        this.onChange();
        this.show();
    }

    /** Takes the orbit at the operating point, or nothing while another orbit is shown. */
    orbitTaken(head: Head | undefined): void {
        this.orbit = head;
        this.show();
    }

    /** Takes the result of a run from the start of the spec. */
    runTaken(words: string): void {
        if (this.periodic) this.run = words;
        else this.message = words;
        this.show();
    }

    private show(): void {
        const { words, warnings, stop } = this.parts;
        const text = this.text();
        if (words.textContent !== text) words.textContent = text;
        words.ariaBusy = String(this.computing);
        stop.hidden = !(this.computing && this.slow);
        const found = ((this.orbit?.warnings ?? []) as string[]).join(". ");
        if (warnings.textContent !== found) warnings.textContent = found;
        warnings.hidden = found === "";
    }

    private text(): string {
        const { head, attractor } = this;
        if (this.message) return this.message;
        if (this.periodic === false) return "The drives of this spec have no common period.";
        if (!head || !attractor) return [this.run || "Operating point", this.computing && (this.progress || `integrating ${STARTS[0]} starts`)].filter(Boolean).join(": ");
        const share = (own: Attractor) => `${digits(100 * own.fraction, 3)} % (95 %: ${digits(100 * own.fraction_low, 2)} to ${digits(100 * own.fraction_high, 2)}) of ${head.finished} starts`;
        const kind = (own: Attractor) => (own.period_cycles > 0 ? `period ${own.period_cycles}, stable` : own.id);
        const others = (head.attractors as Attractor[]).filter((own) => own !== attractor);
        const more = others.map((own) => `${quantity(own.mean_power_w, "W")}, ${kind(own)}, by ${share(own)}`);
        return [
            `At ${quantity(head.frequency_hz, "Hz", 5)}: ${quantity(attractor.mean_power_w, "W")}, ${kind(attractor)}, reached by ${share(attractor)} drawn at random${this.limits()}`,
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
