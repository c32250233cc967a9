// Orbit of the selected point: histories, phase portrait, spectrum, force, multipliers, and the motion of the beams and plates.

import { Chart } from "./chart";
import { Cursor } from "./cursor";
import type { Frame } from "./frame";
import { Motion } from "./motion";
import { Plates } from "./plates";
import { orbitStability } from "./stability";
import { drawStretch, stretchWords } from "./stretch";
import { colour, nth } from "./theme";
import { digits, printed, quantity } from "./units";

const find = (id: string) => document.getElementById(id)!;

export class Orbit {
    readonly motion = new Motion(find("motion") as HTMLCanvasElement, new Plates(find("plate-motion")));
    readonly displacement = new Chart(find("chart-displacement"), true);
    readonly phase = new Chart(find("chart-phase"), true);
    readonly voltage = new Chart(find("chart-voltage"), true);
    private readonly force = new Chart(find("chart-force"), true);
    private readonly spectrum = new Chart(find("chart-spectrum"), true);
    private readonly multipliers = new Chart(find("chart-multipliers"), true);
    private readonly cursor = new Cursor({ histories: [this.displacement, this.voltage, this.force], phase: this.phase }, this.motion);
    private readonly title = find("orbit-title");
    private readonly warnings = find("orbit-warnings");
    private frame: Frame | undefined;
    /** Stretch of a motion without a period, shown in place of an orbit. */
    private stretch: Frame | undefined;
    private isOld: () => boolean = () => false;
    /** Value of the key of the response, with its unit. */
    private at = "";
    /** True while words stand in place of the orbit. */
    private isCleared = false;

    constructor() {
        const slow = find("slow") as HTMLInputElement;
        const pace = () => {
            this.motion.slower = 10 ** Number(slow.value);
            slow.setAttribute("aria-valuetext", `${digits(this.motion.slower, 2)} times slower`);
        };
        slow.oninput = pace;
        pace();
        const play = find("play") as HTMLButtonElement;
        const show = (playing: boolean) => {
            play.textContent = playing ? "Pause" : "Play";
            play.setAttribute("aria-pressed", String(playing));
        };
        play.onclick = () => show(this.motion.toggle());
        show(this.motion.playing);
    }

    /** Takes an orbit at a value of the key; `isOld` says whether it belongs to an earlier design. */
    take(frame: Frame, at: string, isOld: () => boolean): void {
        this.frame = frame;
        this.at = at;
        this.isOld = isOld;
        this.isCleared = false;
        this.show(undefined);
        this.mark();
        this.motion.take(frame);
        this.draw();
        this.cursor.take(frame);
    }

    /** Shows words in place of the orbit. */
    clear(words: string): void {
        this.title.textContent = words;
        this.warnings.textContent = "";
        this.isCleared = true;
        this.show(undefined);
        this.mark();
    }

    /** Shows a stretch of a motion without a period below the words in place of the orbit. */
    takeStretch(frame: Frame): void {
        this.show(frame);
        this.mark();
        this.cursor.clear();
        drawStretch(frame, this);
    }

    private show(stretch: Frame | undefined): void {
        this.stretch = stretch;
        find("stretch-words").textContent = stretch ? stretchWords(stretch) : "";
        find("orbit").classList.toggle("stretch", stretch !== undefined);
    }

    /** Shows whether the orbit belongs to the present design. */
    mark(): void {
        const isOld = !this.isCleared && this.isOld();
        find("orbit-stale").hidden = !isOld;
        find("orbit").classList.toggle("stale", (this.isCleared && !this.stretch) || isOld);
    }

    redraw(): void {
        if (this.stretch) drawStretch(this.stretch, this);
        else if (this.frame) this.draw();
    }

    private draw(): void {
        const frame = this.frame!;
        const { head } = frame;
        const [time, stops] = [frame.array("time"), head.stops as { name: string; gap: number }[]];
        const seconds = { words: "Time", unit: "s", ends: [0, head.period_s] as [number, number] };
        this.title.textContent = `Orbit at ${this.at}: ${quantity(head.mean_power_w, "W")}, period ${head.period_cycles}, ${orbitStability(head)}`;
        this.warnings.textContent = printed((head.warnings as string[]).join(". "));
        this.free(stops.length === 0);
        if (stops.length > 0) this.contact(frame, stops);
        else this.end(frame);
        this.voltage.show(seconds, { words: "Voltage", unit: "V" }, [{ x: time, y: frame.array("voltage"), colour: colour("green") }]);
        this.amplitudes(frame);
        this.circle(frame);
        this.label(this.voltage, `Voltage over one period: ${quantity(head.voltage_rms_v, "V")} rms`);
        this.label(this.multipliers, `Floquet multipliers and the unit circle: largest modulus ${digits(head.floquet_max_abs)}, ${orbitStability(head)}`);
    }

    /** Without a stop there is no contact force, and no motion towards it. */
    private free(isFree: boolean): void {
        for (const chart of [this.phase, this.force]) chart.host.hidden = isFree;
    }

    /** Displacement of the end of the first beam. */
    private end(frame: Frame): void {
        const { head } = frame;
        const beam = (head.beams as { name: string; places: number }[])[0];
        this.displacement.host.hidden = !beam;
        if (!beam) return;
        const motion = frame.array(`motion.${beam.name}`);
        const index = Array.from({ length: head.pictures as number }, (_, k) => k);
        const [x, y] = [index.map((k) => (k / head.pictures) * head.period_s), index.map((k) => motion[(k + 1) * beam.places - 1])];
        const words = `End of ${beam.name}`;
        this.displacement.show({ words: "Time", unit: "s", ends: [0, head.period_s] }, { words, unit: "m" }, [{ x, y, colour: colour("blue") }]);
        this.label(this.displacement, `${words}: displacement over one period`);
    }

    /** Motion towards each stop, and the contact force. */
    private contact(frame: Frame, stops: { name: string; gap: number }[]): void {
        const { head } = frame;
        const time = frame.array("time");
        const seconds = { words: "Time", unit: "s", ends: [0, head.period_s] as [number, number] };
        const own = (name: string) => stops.map((_, k) => ({ y: frame.array(`${name}.${k}`), colour: nth(k) }));
        const gaps = stops.map((stop) => stop.gap);
        const contacts = `${head.contacts} ${head.contacts === 1 ? "contact" : "contacts"} per period`;
        this.displacement.host.hidden = false;
        this.displacement.show(seconds, { words: "Position", unit: "m" }, own("displacement").map((curve) => ({ x: time, ...curve })), [], gaps.map((at) => ({ at, along: "y", words: "stop" })));
        this.phase.show(
            { words: "Displacement", unit: "m", room: true },
            { words: "Velocity", unit: "m/s" },
            stops.map((_, k) => ({ x: closed(frame.array(`displacement.${k}`)), y: closed(frame.array(`velocity.${k}`)), colour: nth(k) })),
            [],
            gaps.map((at) => ({ at, along: "x", words: "stop" })),
        );
        this.force.show(seconds, { words: "Force", unit: "N" }, own("contact.force").map((curve) => ({ x: frame.array("contact.time"), ...curve, colour: colour("vermilion") })));
        this.label(this.displacement, `Displacement towards the stop over one period: ${contacts}, largest penetration ${quantity(head.max_penetration_m, "m")}`);
        this.label(this.phase, "Phase portrait: velocity over displacement, with the stop as a line");
        const largest = own("contact.force").reduce((most, { y }) => y.reduce((high, force) => Math.max(high, force), most), 0);
        this.label(this.force, `Contact force over one period: ${contacts}, largest force ${quantity(largest, "N")}`);
    }

    private amplitudes(frame: Frame): void {
        const lines = frame.array("spectrum.amplitude");
        const most = lines.reduce((high, value) => Math.max(high, value), 0);
        const curve = { x: frame.array("spectrum.frequency"), y: lines.map((value) => Math.max(value, 1e-6 * most)), colour: colour("purple"), stems: true };
        this.spectrum.waiting = most > 0 ? "" : "no voltage";
        this.spectrum.show({ words: "Frequency", unit: "Hz" }, { words: "Peak", unit: "V", log: true, ends: most > 0 ? [1e-5 * most, 2 * most] : undefined }, most > 0 ? [curve] : []);
        this.label(this.spectrum, "Spectrum of the voltage, up to twelve times the drive frequency");
    }

    private circle(frame: Frame): void {
        const [re, im] = [frame.array("multiplier.re"), frame.array("multiplier.im")];
        const reach = Math.max(1.15, 1.1 * frame.head.floquet_max_abs);
        const ends: [number, number] = [-reach, reach];
        const marks = Array.from(re, (x, k) => ({ x, y: im[k], colour: colour(Math.hypot(x, im[k]) < 1 ? "blue" : "vermilion"), shape: "circle" as const, size: 3 }));
        this.multipliers.show({ words: "Multiplier, real", unit: "", ends }, { words: "imaginary", unit: "", ends }, [], marks, [], true);
    }

    private label(chart: Chart, words: string): void {
        chart.host.setAttribute("aria-label", words);
    }
}

/** Appends the first value to close a curve. */
function closed(values: Float64Array): number[] {
    return [...values, values[0]];
}
