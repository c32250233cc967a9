// Response under noise, or under a recording dropped onto the page.

import { Chart } from "./chart";
import type { Controls } from "./controls";
import type { Design } from "./design";
import type { Frame } from "./frame";
import { colour } from "./theme";
import { digits, printed, quantity, sign } from "./units";
import { Stale } from "./stale";
import type { Request, Wire } from "./wire";

/** Largest file that is sent. */
const MOST_BYTES = 11 << 20;

/** What excites the harvester, as the server takes it. */
type Excitation = "spec" | { noise: { density: number; low_hz: number; high_hz: number } } | { recording: { name: string; bytes: string; channel: string | null; scale: number } };

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const number = (id: string) => Number(find<HTMLInputElement>(id).value);

export class Shake {
    private readonly voltage = new Chart(find("chart-shake-voltage"), true);
    private readonly displacement = new Chart(find("chart-shake-displacement"), true);
    private readonly density = new Chart(find("chart-shake-density"), true);
    private readonly words = find("shake-words");
    private last: Frame | undefined;
    private running = false;
    private readonly stale: Stale;
    /** Number of runs that were started: a file that is read later than a newer one was chosen is dropped. */
    private runs = 0;
    /** True once the user has started a run. */
    private chosen = false;
    private offered = false;
    /** Size of the unit in which the density of the noise is typed, SI. */
    private densityFactor = 1;
    /** Called with the result under the drives of the spec. */
    onSpec: (words: string, warnings: string[], request: Request) => void = () => {};

    constructor(private readonly wire: Wire, private readonly controls: Controls, private readonly design: Design, private readonly show: () => void) {
        this.stale = new Stale(find("panel-shake"), find("shake-stale"), design);
        wire.on("shake", (frame, request) => this.take(frame, request));
        find("shake-spec").onclick = () => this.choose(() => this.ofSpec());
        find("shake-run").onclick = () => this.choose(() => this.noise());
        find("shake-stop").onclick = () => this.stop();
        const chosen = find<HTMLInputElement>("shake-file");
        chosen.onchange = () => chosen.files?.[0] && this.choose(() => void this.recording(chosen.files![0]));
    }

    /** Integrates under a recording that was dropped on the page. */
    dropped(file: File): void {
        this.show();
        this.choose(() => void this.recording(file));
    }

    /** Offers the noise of the spec, or else noise with the power of the first sinusoid in an octave and a half around it. */
    offer(): void {
        const control = (name: string) => this.controls.all.find(({ key }) => new RegExp(`^drive\\.[^.]+\\.${name}$`).test(key));
        const [density, low, high, amplitude, frequency] = ["psd", "low", "high", "amplitude", "frequency"].map(control);
        if (this.offered) return;
        if (density && high) this.put(density.value, density, [low?.value ?? 0, high.value], 6);
        else if (amplitude?.value && frequency?.value) {
            const hertz = frequency.value;
            const unit = /^[A-Za-z]*$/.test(amplitude.unit) ? amplitude.unit : `(${amplitude.unit})`;
            this.put(amplitude.value ** 2 / 2 / hertz, { unit: `${unit}^2/Hz`, factor: amplitude.factor ** 2 }, [0.5 * hertz, 1.5 * hertz], 2);
        }
    }

    /** Fills in a noise: its density in a unit, and its band. */
    private put(density: number, { unit, factor }: { unit: string; factor: number }, [low, high]: [number, number], count: number): void {
        this.offered = true;
        this.densityFactor = factor;
        find("shake-density-unit").textContent = sign(unit);
        const texts = { "shake-density": density / factor, "shake-low": low, "shake-high": high };
        for (const [id, value] of Object.entries(texts)) find<HTMLInputElement>(id).value = digits(value, count);
    }

    /** Integrates under the drives of the spec. */
    ofSpec(): void {
        this.runs++;
        this.ask("spec");
    }

    /** Integrates under the drives of the spec, unless the user has started a run. */
    offerSpec(): void {
        if (!this.chosen && !this.running) this.ofSpec();
    }

    /** Starts a run of the user; it takes the place of one that is under way. */
    private choose(run: () => void): void {
        this.chosen = true;
        run();
    }

    private noise(): void {
        const [density, low_hz, high_hz] = ["shake-density", "shake-low", "shake-high"].map(number);
        if (![density, low_hz, high_hz].every(Number.isFinite)) return this.say("noise needs three numbers: its density and the ends of its band");
        this.runs++;
        this.ask({ noise: { density: density * this.densityFactor, low_hz, high_hz } });
    }

    private async recording(file: File): Promise<void> {
        if (file.size > MOST_BYTES) return this.say(`${file.name} is larger than ${MOST_BYTES >> 20} MiB; cut it into pieces`);
        const scale = number("shake-scale");
        if (!Number.isFinite(scale)) return this.say("the scale of a recording must be a number");
        const run = ++this.runs;
        this.wire.stop("shake");
        this.set(true);
        this.say(`reading ${file.name}`);
        const channel = find<HTMLInputElement>("shake-channel").value.trim();
        const bytes = await base64(file);
        if (run === this.runs) this.ask({ recording: { name: file.name, bytes, channel: channel === "" ? null : channel, scale } });
    }

    private ask(by: Excitation): void {
        this.set(this.wire.ask("shake", { set: this.design.pairs, by }) !== 0);
        this.say(`integrating under ${nameOf(by)}`);
    }

    private stop(): void {
        this.runs++;
        this.wire.stop("shake");
        this.set(false);
        this.say("stopped");
    }

    /** Shows whether the result belongs to the present design. */
    mark(): void {
        this.stale.mark();
    }

    /** The lost connection has taken the computation with it. */
    forget(): void {
        if (!this.running) return;
        this.set(false);
        this.say("stopped: the connection was lost");
    }

    private set(running: boolean): void {
        this.running = running;
        find("shake-stop").hidden = !running;
    }

    private say(words: string): void {
        this.words.textContent = words;
    }

    private take(frame: Frame, request: Request): void {
        const { head } = frame;
        const by = nameOf(request.body.by);
        if (head.stage === "progress") return this.say(`integrating under ${by}: ${Math.round((100 * head.done) / head.of)} %`);
        this.set(false);
        if (head.stage === "fault") return this.say(head.faults[0]?.message ?? "");
        const linear = head.linear_power_w > 0 ? ` (the same harvester without contact: ${quantity(head.linear_power_w, "W")})` : "";
        const contacts = frame.has("displacement.time") ? `; ${(head.contacts / head.average_over_s).toFixed(1)} contacts per second` : "";
        const name = head.channel ? `${by} (${head.channel})` : by;
        const noticed = head.issues?.length > 0 ? `. Issues: ${head.issues.join("; ")}` : "";
        const words = `${name}: ${quantity(head.mean_power_w, "W")} on average over ${quantity(head.average_over_s, "s")}${linear}${contacts}${noticed}`;
        this.say(printed([words, ...head.warnings].join(". ")));
        this.last = frame;
        this.stale.shows(request);
        if (request.body.by === "spec") this.onSpec(words, head.warnings, request);
        this.redraw();
    }

    redraw(): void {
        const { last } = this;
        if (!last) return;
        const time = { words: "Time", unit: "s" };
        this.voltage.host.setAttribute("aria-label", `Voltage over time. ${this.words.textContent}`);
        this.voltage.show(time, { words: "Voltage", unit: "V" }, [{ x: last.array("voltage.time"), y: last.array("voltage.value"), colour: colour("blue"), width: 1 }]);
        this.displacement.host.hidden = !last.has("displacement.time");
        if (last.has("displacement.time")) {
            const curve = { x: last.array("displacement.time"), y: last.array("displacement.value"), colour: colour("green"), width: 1 };
            this.displacement.show(time, { words: "Position", unit: "m" }, [curve], [], [{ at: last.head.gap_m, along: "y", words: "stop" }]);
        }
        if (last.has("density.value")) {
            const curve = { x: last.array("density.frequency"), y: last.array("density.value"), colour: colour("blue"), width: 1 };
            this.density.show({ words: "Frequency", unit: "Hz" }, { words: "Density", unit: "V²/Hz", log: true }, [curve]);
        }
    }
}

/** Words for what excites the harvester. */
function nameOf(by: Excitation): string {
    if (by === "spec") return "the drives of the spec";
    return "recording" in by ? by.recording.name : "other noise";
}

function base64(file: File): Promise<string> {
    return new Promise((resolve, reject) => {
        const reader = new FileReader();
        // The prefix before the comma specifies the kind of the file.
        reader.onload = () => resolve((reader.result as string).split(",")[1] ?? "");
        reader.onerror = () => reject(reader.error);
        reader.readAsDataURL(file);
    });
}
