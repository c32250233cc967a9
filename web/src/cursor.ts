// One time on all charts of an orbit, in its phase portrait, and in the motion of the beam.

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
        for (const chart of charts.histories) {
            chart.host.addEventListener("pointermove", (event) => this.point(chart, event));
            chart.host.addEventListener("pointerleave", () => motion.release());
        }
    }

    take(frame: Frame): void {
        this.frame = frame;
        this.place(this.motion.shown);
    }

    private point(chart: Chart, event: PointerEvent): void {
        const left = chart.over?.getBoundingClientRect().left;
        if (left === undefined || !this.frame) return;
        this.motion.hold(Math.min(Math.max(chart.valueAt(event.clientX - left) / this.frame.head.period_s, 0), 1 - 1e-9));
    }

    private place(phase: number): void {
        const { frame } = this;
        if (!frame) return;
        const at = phase * frame.head.period_s;
        for (const chart of this.charts.histories) chart.cursor(at);
        const now = (name: string): number | undefined => {
            const history = frame.array(name);
            return history[Math.floor(phase * history.length) % history.length];
        };
        const [displacement, velocity] = [now("displacement.0"), now("velocity.0")];
        if (displacement !== undefined) this.charts.phase.cursor(displacement, velocity);
        this.slider.value = String(Math.round(phase * Number(this.slider.max)));
        const values = [quantity(at, "s", 3), ...([[displacement, "m"], [velocity, "m/s"], [now("voltage"), "V"], [now("force.0"), "N"]] as const).flatMap(([value, unit]) => (value === undefined ? [] : [quantity(value, unit, 3)]))];
        const text = values.join(", ");
        this.slider.setAttribute("aria-valuetext", text);
        this.words.textContent = this.motion.playing ? "" : text;
    }
}
