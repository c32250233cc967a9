// The operating point: what the present design does at its own drive, from a cloud of starts, or from realisations of noise.

import type { Design } from "./design";
import type { Frame, Head } from "./frame";
import { safetyWords } from "./safety";
import type { AttractorPlace } from "./shown-orbit";
import { digits, printed, quantity } from "./units";
import type { Wire } from "./wire";

export interface Attractor {
    id: string;
    period_cycles: number;
    mean_power_w: number;
    contacts_per_period: number;
    fraction: number;
    fraction_low: number;
    fraction_high: number;
}

/** Limit of a patch, with the value that exceeds it most or is nearest to it. */
export interface Limit {
    patch: string;
    quantity: string;
    reached: number;
    limits: [number, number];
    /** The limit that the value exceeds or is nearest to, and the excess over it; negative within. */
    bound: number;
    excess: number;
}

/** Peaks and warnings of an attractor. */
export interface Peaks {
    strain_peak: number | null;
    voltage_peak_v: number | null;
    /** Null where the peaks are not known. */
    max_impact_velocity_m_s: number | null;
    limits: Limit[];
    warnings: string[];
}

interface Parts {
    words: HTMLElement;
    warnings: HTMLElement;
    /** Limits for all starts. */
    safety: HTMLElement;
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
    private message = "";
    /** Result of a run from the start of the spec, until the attractors are known. */
    private run = "";
    /** Warnings of that run. */
    private runWarnings: string[] = [];
    /** Result over many realisations of the noise of the spec. */
    private ensemble: Head | undefined;
    private noisy = false;
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
        wire.on("ensemble", (frame) => this.takeEnsemble(frame));
        parts.stop.onclick = () => this.stop();
    }

    /** The attractor that most starts reach, where it has an orbit. */
    get place(): AttractorPlace | undefined {
        return this.head && this.attractor && this.attractor.period_cycles > 0 ? { attractors: this.head.id, attractor: this.attractor.id } : undefined;
    }

    /** Number of the attractors. */
    get number(): number | undefined {
        return this.head?.id;
    }

    /** Drive frequency of the attractors, Hz. */
    get hertz(): number {
        return this.head?.frequency_hz;
    }

    /** Clears what belongs to an earlier design. */
    mark(): void {
        if (this.signature === this.design.signature) return;
        this.signature = this.design.signature;
        this.requested = "";
        this.stopAll();
        for (const timer of this.timers) clearTimeout(timer);
        this.attractor = this.head = this.ensemble = undefined;
        this.message = this.run = this.progress = "";
        this.runWarnings = [];
        this.slow = this.computing = false;
        this.show();
    }

    /** Requests the attractors of the present design once it rests; `hertz` is null without a periodic drive. */
    designTaken(hertz: number | null, noisy: boolean): void {
        this.periodic = hertz !== null;
        this.noisy = noisy;
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

    private stopAll(): void {
        this.wire.stop("operating-point");
        this.wire.stop("ensemble");
    }

    private stop(): void {
        this.stopAll();
        this.computing = false;
        this.progress = "";
        if (this.periodic && !this.head) this.message = ["Operating point: stopped", this.run].filter(Boolean).join(". ");
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

    /** Takes the result of a run from the start of the spec; one under noise is followed by an ensemble. */
    runTaken(words: string, warnings: string[]): void {
        this.run = words;
        this.runWarnings = warnings;
        if (!this.periodic && this.noisy && !this.ensemble && !this.computing) {
            this.computing = this.slow = this.wire.ask("ensemble", { set: this.design.pairs }) !== 0;
        }
        this.show();
    }

    private takeEnsemble({ head }: Frame): void {
        if (head.stage === "progress") {
            this.progress = `${Math.round((100 * head.done) / head.of)} %`;
            return this.show();
        }
        this.computing = false;
        this.progress = "";
        if (head.stage === "fault") this.runWarnings = [...this.runWarnings, head.faults[0]?.message ?? ""];
        else this.ensemble = head;
        this.show();
    }

    private show(): void {
        const { words, warnings, safety, stop } = this.parts;
        const text = this.text();
        if (words.textContent !== text) words.textContent = text;
        words.ariaBusy = String(this.computing);
        stop.hidden = !(this.computing && this.slow);
        const found = printed(this.warnings().join(". "));
        if (warnings.textContent !== found) warnings.textContent = found;
        warnings.hidden = found === "";
        const limits = this.head && this.attractor && !this.message ? safetyWords(this.head) : "";
        if (safety.textContent !== limits) safety.textContent = limits;
        safety.hidden = limits === "";
        safety.className = this.head?.limit_shares.beyond.fraction > 0 ? "warning" : "words";
    }

    private text(): string {
        const { head, attractor } = this;
        if (this.message) return this.message;
        if (this.periodic === false) return this.noiseText();
        if (!head || !attractor) return [this.run || "Operating point", this.computing && (this.progress || `integrating ${STARTS[0]} starts`)].filter(Boolean).join(": ");
        const share = (own: Attractor, about = "") => `${digits(100 * own.fraction, 3)} % (${about}${digits(100 * own.fraction_low, 2)} to ${digits(100 * own.fraction_high, 2)})`;
        const kind = (own: Attractor) => (own.period_cycles > 0 ? `period ${own.period_cycles}` : own.id);
        const others = (head.attractors as Attractor[]).filter((own) => own !== attractor);
        const more = others.map((own) => `${quantity(own.mean_power_w, "W")}, ${kind(own)}, by ${share(own)}`);
        return [
            `At ${quantity(head.frequency_hz, "Hz", 5)}: ${quantity(attractor.mean_power_w, "W")}, ${kind(attractor)}${attractor.period_cycles > 0 ? ", stable" : ""}, reached by ${share(attractor, "95 %: ")} of ${head.finished} starts drawn at random${this.peaksText(attractor)}`,
            ...(more.length > 0 ? [`also ${more.join("; ")}`] : []),
        ].join("; ");
    }

    private noiseText(): string {
        const { ensemble, run } = this;
        if (!run) return "The drives of this spec have no common period.";
        if (!ensemble) return [run, ...(this.computing ? [`more realisations of the noise: ${this.progress || "starting"}`] : [])].join("; ");
        const half = ensemble.mean_power_half_width_w;
        const interval = half === null ? "" : ` ± ${quantity(half, "W", 2)}`;
        return `${quantity(ensemble.mean_power_w, "W")}${interval} (95 %, ${ensemble.members.length} realisations of the noise). ${run}`;
    }

    /** Warnings of the attractor, then of the others; under noise those of the run and of its realisations. */
    private warnings(): string[] {
        const { head, attractor } = this;
        if (!head || !attractor) return [...this.runWarnings, ...((this.ensemble?.warnings ?? []) as string[])];
        const others = (head.attractors as Attractor[]).filter((own) => own !== attractor);
        const named = others.flatMap((own) => this.peaks(own).warnings.map((warning) => `At ${quantity(own.mean_power_w, "W")}, ${warning}`));
        return [...this.peaks(attractor).warnings, ...named];
    }

    private peaks(attractor: Attractor): Peaks {
        return this.head!.peaks[this.head!.attractors.indexOf(attractor)];
    }

    /** Strain with its limit, voltage, and contacts of an attractor. */
    private peaksText(attractor: Attractor): string {
        const { strain_peak, voltage_peak_v, limits } = this.peaks(attractor);
        const { stops } = this.head!;
        const limited = limits.filter((own) => own.quantity === "strain");
        const nearest = limited.sort((a, b) => Math.abs(b.reached / b.limits[1]) - Math.abs(a.reached / a.limits[1]))[0];
        const ppm = (strain: number) => digits(1e6 * Math.abs(strain), 3);
        const contacts = attractor.contacts_per_period / attractor.period_cycles;
        const parts = [
            nearest ? `strain ${ppm(nearest.reached)} ppm of ${ppm(nearest.limits[1])}` : strain_peak === null ? "" : `strain ${ppm(strain_peak)} ppm`,
            voltage_peak_v === null ? "" : `voltage ${quantity(voltage_peak_v, "V", 3)} peak`,
            stops === 0 || attractor.period_cycles === 0 ? "" : contacts > 0 ? `${digits(contacts, 3)} ${contacts === 1 ? "contact" : "contacts"} per drive cycle` : stops === 1 ? "the stop is not struck" : "no stop is struck",
        ];
        return parts.filter(Boolean).map((part) => `, ${part}`).join("");
    }
}
