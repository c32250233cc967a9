// One instant on all charts of an orbit, in its phase portrait, and in the motion of the beams. Each of them can be pointed at.

import type { Chart } from "./chart";
import type { Frame } from "./frame";
import type { Motion } from "./motion";
import { quantity } from "./units";

interface Charts {
    /** Charts over time. */
    histories: Chart[];
    phase: Chart;
}

export class Cursor {
    private frame: Frame | undefined;
    private readonly slider = document.getElementById("phase") as HTMLInputElement;
    private readonly words = document.getElementById("orbit-cursor")!;

    constructor(private readonly charts: Charts, private readonly motion: Motion) {
        motion.onPhase = (phase) => this.place(phase);
        this.slider.oninput = () => motion.hold(Number(this.slider.value) / Number(this.slider.max));
        this.slider.onchange = () => motion.release();
        for (const chart of charts.histories) this.pointed(chart.host, (event) => this.onHistory(chart, event));
        this.pointed(charts.phase.host, (event) => this.onPortrait(event));
        this.pointed(motion.canvas, (event) => motion.phaseAt(event));
    }

    take(frame: Frame): void {
        this.frame = frame;
        this.place(this.motion.shown);
    }

    /** Shows the phase under the pointer, as a fraction of the period, as long as the pointer is over an element. */
    private pointed(host: HTMLElement, phaseAt: (event: PointerEvent) => number | undefined): void {
        host.addEventListener("pointermove", (event) => {
            const phase = this.frame && phaseAt(event);
            if (phase !== undefined) this.motion.hold(phase);
        });
        host.addEventListener("pointerleave", () => this.motion.release());
    }

    private onHistory(chart: Chart, event: PointerEvent): number | undefined {
        const left = chart.over?.getBoundingClientRect().left;
        return left === undefined ? undefined : Math.min(Math.max(chart.valueAt(event.clientX - left) / this.frame!.head.period_s, 0), 1 - 1e-9);
    }

    private onPortrait(event: PointerEvent): number | undefined {
        const found = this.charts.phase.nearest(event);
        const { length } = this.frame!.array("time");
        return found && (found.point % length) / length;
    }

    /** Shows no instant: the charts do not show an orbit. */
    clear(): void {
        this.frame = undefined;
        for (const chart of this.charts.histories) chart.cursor();
        this.charts.phase.cursor();
        this.words.textContent = "";
    }

    private place(phase: number): void {
        const { frame } = this;
        if (!frame) return;
        const at = phase * frame.head.period_s;
        for (const chart of this.charts.histories) chart.cursor([at]);
        const now = (name: string): number | undefined => {
            const history = frame.array(name);
            return history[Math.floor(phase * history.length + 1e-6) % history.length];
        };
        const stops = (frame.head.stops as unknown[]).map((_, k): [number, number] => [now(`displacement.${k}`)!, now(`velocity.${k}`)!]);
        this.charts.phase.cursor(...stops);
        this.slider.value = String(Math.round(phase * Number(this.slider.max)));
        const force = frame.has("contact.force.0") ? between(frame.array("contact.time"), frame.array("contact.force.0"), at) : undefined;
        const [displacement, velocity] = stops[0] ?? [];
        const values = [quantity(at, "s", 3), ...([[displacement, "m"], [velocity, "m/s"], [now("voltage"), "V"], [force, "N"]] as const).flatMap(([value, unit]) => (value === undefined ? [] : [quantity(value, unit, 3)]))];
        const text = values.join(", ");
        this.slider.setAttribute("aria-valuetext", text);
        this.words.textContent = this.motion.playing ? "" : text;
    }
}

/** Value of a curve between its points, whose abscissas increase. */
function between(x: Float64Array, y: Float64Array, at: number): number {
    let [low, high] = [0, x.length - 1];
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (x[middle] <= at) low = middle;
        else high = middle;
    }
    const share = x[high] > x[low] ? Math.min(Math.max((at - x[low]) / (x[high] - x[low]), 0), 1) : 0;
    return y[low] + share * (y[high] - y[low]);
}
