// Basins of attraction: plane of displacement and velocity, coloured by attractor, with fractions and expected power.

import { Chart } from "./chart";
import type { Design } from "./design";
import type { Frame } from "./frame";
import type { LegendEntry } from "./legend";
import type { AttractorPlace, ShownOrbit } from "./shown-orbit";
import { colour, shade } from "./theme";
import { digits, quantity } from "./units";
import { Plane } from "./plane";
import { Stale } from "./stale";
import type { Request, Wire } from "./wire";

interface Attractor {
    id: string;
    period_cycles: number;
    mean_power_w: number;
    fraction: number;
    fraction_low: number;
    fraction_high: number;
}

/** Coarser than the default 1e-8 of `jounce basins`: the page shows the shape of the basins within seconds. */
const TOLERANCE = 1e-6;
const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

export class Basins {
    private readonly chart = new Chart(find("chart-basins"));
    private readonly words = find("basins-words");
    private readonly note = find("basins-note");
    private readonly bar = find<HTMLProgressElement>("basins-progress");
    private frame: Frame | undefined;
    private running = false;
    /** Plane of the last request. */
    private requested = "";
    /** Number of the start that was clicked. */
    private picked: number | undefined;
    /** Why the last attractor that was picked has no orbit to show. */
    private refusal = () => "";
    /** Direction of the displacement and the velocity of a start. */
    private direction = "";
    /** Called with the attractor that is clicked. */
    onPick: (place: AttractorPlace) => void = () => {};
    /** Called when another plane is chosen. */
    onPlane: () => void = () => {};
    /** Called with new basins, which may have the orbit that is shown. */
    onTake: () => void = () => {};
    /** The plane of starts. */
    readonly plane = new Plane(() => {
        this.stale.mark();
        this.onPlane();
    });
    private readonly stale: Stale;

    constructor(private readonly wire: Wire, private readonly design: Design, private readonly orbit: ShownOrbit) {
        this.stale = new Stale(find("panel-basins"), find("basins-stale"), design, () => this.plane.text);
        wire.on("basins", (frame, request) => this.take(frame, request));
        find("basins-run").onclick = () => (this.running ? this.stop() : this.run());
        const { host } = this.chart;
        host.addEventListener("click", (event) => this.click(event));
        host.addEventListener("pointermove", (event) => this.hover(event));
        host.addEventListener("pointerleave", () => (find("basins-cursor").textContent = ""));
    }

    run(): void {
        const { fault, options } = this.plane;
        if (fault) {
            this.words.textContent = fault;
            return;
        }
        this.set(this.wire.ask("basins", { set: this.design.pairs, ...options, tolerance: TOLERANCE }) !== 0);
        this.requested = this.plane.text;
        this.bar.value = 0;
        this.words.textContent = "integrating";
    }

    private stop(): void {
        this.wire.stop("basins");
        this.set(false);
        this.words.textContent = "stopped";
    }

    /** Takes the first stop of the design. */
    designTaken(stop: string | undefined): void {
        this.direction = stop === undefined ? "" : ` towards stop ${stop}`;
    }

    /** Shows whether the result belongs to the present design. */
    mark(): void {
        this.stale.mark();
        this.tellOrbit();
    }

    /** The lost connection has taken the computation with it. */
    forget(): void {
        if (!this.running) return;
        this.set(false);
        this.words.textContent = "stopped: the connection was lost";
    }

    private set(running: boolean): void {
        this.running = running;
        this.bar.hidden = !running;
        find("basins-run").textContent = running ? "Stop" : "Run";
    }

    private take(frame: Frame, request: Request): void {
        const { head } = frame;
        if (head.stage === "fault") {
            this.set(false);
            this.words.textContent = head.faults[0]?.message ?? "";
        } else if (head.stage === "progress") {
            this.bar.value = head.done / head.of;
            const left = (head.seconds / head.done) * (head.of - head.done);
            this.words.textContent = `${head.done} of ${head.of} starts, ${digits(left, 2)} s left`;
        } else {
            this.set(false);
            this.frame = frame;
            this.picked = undefined;
            this.refusal = () => "";
            find("basins-about").hidden = true;
            this.stale.shows(request, this.requested);
            this.onTake();
            this.tellOrbit();
            const [expected, low, high] = [head.expected_power_w, head.expected_power_low_w, head.expected_power_high_w].map((watt) => quantity(watt, "W"));
            this.words.textContent = `at ${quantity(head.frequency_hz, "Hz")}: expected power ${expected} (95 %: ${low} to ${high})${head.failed.length > 0 ? `, ${head.failed.length} runs failed` : ""}; ${this.plane.taken(frame)}`;
            this.redraw();
        }
    }

    /** The start that is nearest to the pointer. */
    private nearest(event: MouseEvent): number | undefined {
        const box = this.chart.over?.getBoundingClientRect();
        if (!this.frame || !box) return undefined;
        const [x, y] = ["displacement_m", "velocity_m_s"].map((name) => this.frame!.array(name));
        const away = (k: number) => {
            const [left, top] = this.chart.place(x[k], y[k]);
            return Math.hypot(left + box.left - event.clientX, top + box.top - event.clientY);
        };
        let nearest = 0;
        for (let k = 1; k < x.length; k++) if (away(k) < away(nearest)) nearest = k;
        return nearest;
    }

    private attractorOf(start: number): Attractor | undefined {
        return (this.frame!.head.attractors as Attractor[])[this.frame!.array("attractor")[start]];
    }

    /** Shows the orbit of the attractor of the start that is clicked. */
    private click(event: MouseEvent): void {
        const start = this.nearest(event);
        if (start === undefined) return;
        this.picked = start;
        this.redraw();
        this.pick(this.attractorOf(start));
    }

    /** Shows the start under the pointer, and where it ends. */
    private hover(event: MouseEvent): void {
        const start = this.nearest(event);
        if (start === undefined) return;
        const [x, y] = ["displacement_m", "velocity_m_s"].map((name) => this.frame!.array(name)[start]);
        const end = this.attractorOf(start);
        find("basins-cursor").textContent = `Start at ${quantity(x, "m", 3)}, ${quantity(y, "m/s", 3)}: ${end ? `${end.id}, ${quantity(end.mean_power_w, "W")}` : "no attractor"}`;
    }

    private pick(attractor: Attractor | undefined): void {
        this.refusal = () => {
            if (!attractor) return "This start has no attractor.";
            if (this.stale.isOld) return "These basins are of an earlier design; run them again.";
            return attractor.period_cycles === 0 ? `${attractor.id} has no periodic orbit.` : "";
        };
        this.tellOrbit();
        if (!attractor || this.refusal() !== "") return;
        this.note.textContent = `The orbit of ${attractor.id} is being computed.`;
        this.onPick({ attractors: this.frame!.head.id, attractor: attractor.id });
    }

    /** Names the attractor whose orbit is shown, or says why the picked one has none. */
    tellOrbit(): void {
        const shown = this.frame && !this.stale.isOld ? this.orbit.among(this.frame.head.id) : undefined;
        this.note.textContent = this.refusal() || (shown ? `The orbit of ${shown} is shown.` : "");
    }

    /** The starts, and the attractor where each ends. */
    table(): string | undefined {
        if (!this.frame) return undefined;
        const attractors = this.frame.head.attractors as Attractor[];
        const [x, y, attractor] = ["displacement_m", "velocity_m_s", "attractor"].map((name) => this.frame!.array(name));
        const lines = Array.from(x, (own, k) => {
            const end = attractors[attractor[k]];
            return [own, y[k], ...(end ? [end.id, end.period_cycles, end.mean_power_w] : ["", "", ""])].join(",");
        });
        return `displacement_m,velocity_m_s,attractor,period_cycles,mean_power_w\n${lines.join("\n")}\n`;
    }

    /** Legend of the map: the attractors. */
    legend(): LegendEntry[] {
        const attractors = (this.frame?.head.attractors ?? []) as Attractor[];
        const known = attractors.map((own, k) => ({ words: attractorWords(own), colour: shade(k), area: true }));
        const isLost = this.frame?.array("attractor").includes(-1);
        return [...known, ...(isLost ? [{ words: "no attractor", colour: colour("grey"), area: true }] : [])];
    }

    redraw(): void {
        if (!this.frame) return;
        const { head } = this.frame;
        const attractors = head.attractors as Attractor[];
        const [x, y, attractor] = ["displacement_m", "velocity_m_s", "attractor"].map((name) => this.frame!.array(name));
        const cell = [step(x), step(y)] as [number, number];
        const ends = (values: Float64Array, size: number): [number, number] => [Math.min(...values) - size / 2, Math.max(...values) + size / 2];
        const curves = [...attractors.keys(), -1].map((k) => {
            const own = [...attractor.keys()].filter((index) => attractor[index] === k);
            return { x: own.map((index) => x[index]), y: own.map((index) => y[index]), colour: k < 0 ? colour("grey") : shade(k), cell };
        });
        this.chart.show({ words: `Displacement${this.direction}`, unit: "m", ends: ends(x, cell[0]) }, { words: `Velocity${this.direction}`, unit: "m/s", ends: ends(y, cell[1]) }, curves, this.picked === undefined ? [] : [{ x: x[this.picked], y: y[this.picked], colour: colour("ink"), shape: "ring", size: 7 }]);
        const legend = attractors.map((a, k) => {
            const item = document.createElement("li");
            item.style.setProperty("--own", shade(k));
            const button = document.createElement("button");
            button.textContent = attractorWords(a);
            button.title = "Show the orbit";
            button.onclick = () => this.pick(a);
            item.append(button);
            return item;
        });
        find("attractors").replaceChildren(...legend);
        this.chart.host.setAttribute("aria-label", `Attractors of ${x.length} starts. ${legend.map((item) => item.textContent).join("; ")}`);
    }
}

/** Share of the starts of an attractor, and its power. */
function attractorWords(own: Attractor): string {
    const share = (value: number) => `${digits(100 * value, 3)} %`;
    return `${own.id}: ${share(own.fraction)} of the starts of the map (${share(own.fraction_low)} to ${share(own.fraction_high)}), ${quantity(own.mean_power_w, "W")}`;
}

/** Distance between neighbouring values of a grid. */
function step(values: Float64Array): number {
    const sorted = [...new Set(values)].sort((a, b) => a - b);
    return sorted.length > 1 ? (sorted[sorted.length - 1] - sorted[0]) / (sorted.length - 1) : 1;
}
