// Result of a design search: what has changed, goals, limits with their prices, share of the starts, fold, tolerances, warnings.

import type { Controls } from "./controls";
import type { Head } from "./frame";
import type { Problem } from "./problem";
import { digits, quantity, sign } from "./units";

interface Limit {
    name: string;
    value: number | null;
    limit: number;
    /** True where the value must be at least the limit. */
    is_lower: boolean;
    active: boolean;
    price: number | null;
    /** Amount, relative to the limit, by which it is exceeded. */
    violation: number;
}

interface Key {
    key: string;
    value: string;
    before: string;
    at_end: string | null;
}

/** State of a limit that is not met. */
const NOT_MET = "not met";
const share = (value: number) => `${digits(100 * value, 3)} %`;

export class Outcome {
    constructor(private readonly host: HTMLElement, private readonly problem: Problem, private readonly controls: Controls) {}

    clear(): void {
        this.host.replaceChildren();
        this.host.hidden = true;
    }

    /** Shows the result of a search. */
    show(head: Head): void {
        const { best, before, limits, warnings } = head;
        const goals = Object.keys(best.goals).map((name) => [name.replaceAll("-", " "), this.problem.goalText(name, before.goals[name]), this.problem.goalText(name, best.goals[name]), ""]);
        const keys = (best.keys as Key[]).map((key) => [this.controls.title(key.key), this.value(key.before), this.value(key.value), key.at_end ? `at its ${key.at_end} end` : ""]);
        this.put([
            table("Before and after", ["", "before", "after", ""], [...goals, ...keys]),
            ...this.limits(limits),
            ...[...this.sentences(head), ...(warnings as string[])].map(line),
        ]);
    }

    /** Shows the last better design of a search that was stopped. */
    showStopped(head: Head): void {
        const keys = Object.entries(head.set as Record<string, string>).map(([key, value]) => [this.controls.title(key), this.value(value)]);
        const { goalName } = this.problem;
        this.put([
            table("Best design so far", ["", "value"], [[goalName.replaceAll("-", " "), this.problem.goalText(goalName, head.goal)], ...keys]),
            ...this.limits(head.limits),
            line("Prices, nearest fold and tolerances are computed at the end of a search."),
        ]);
    }

    private put(parts: HTMLElement[]): void {
        this.host.replaceChildren(...parts);
        this.host.hidden = false;
    }

    /** A number with its unit, with four digits; another text as it is. */
    private value(text: string): string {
        const [number, unit] = text.split(" ");
        return text !== "" && Number.isFinite(Number(number)) ? `${digits(Number(number), 4)} ${sign(unit ?? "")}`.trim() : text;
    }

    private limits(limits: Limit[]): HTMLElement[] {
        if (limits.length === 0) return [];
        const row = ({ name, value, limit, is_lower, active, price, violation }: Limit) => [
            name.replaceAll(".", " ").replaceAll("_", " "), value === null ? "unknown" : this.problem.limitText(name, value), `${is_lower ? "at least" : "at most"} ${this.problem.limitText(name, limit)}`,
            violation > 0 ? NOT_MET : active ? "binds" : "does not bind", price === null ? "" : this.problem.priceText(name, price),
        ];
        return [table("Limits", ["limit", "value", "allowed", "", "price"], limits.map(row))];
    }

    private sentences({ best, robust, violation_text, evaluations, wall_time_s, ended_by }: Head): string[] {
        const found: string[] = violation_text ? [`${violation_text[0].toUpperCase()}${violation_text.slice(1)}.`] : [];
        if (best.stable) {
            found.push(`Orbit of period ${best.period_cycles}, stable, ${quantity(best.mean_power_w, "W")}, reached by ${share(best.basin_fraction)} of the starts (95 %: ${share(best.basin_fraction_low)} to ${share(best.basin_fraction_high)}).`);
            const fold = best.nearest_fold;
            found.push(fold ? `Nearest fold at ${quantity(fold.frequency_hz, "Hz", 5)}, ${quantity(fold.distance_hz, "Hz", 3)} away.` : "No fold near the frequency of the drive.");
        }
        const { noise } = best;
        if (noise) found.push(`Under ${noise.realisations} realisations of the noise other than that of the search: ${quantity(noise.mean_power_w, "W")} (95 %: ${quantity(noise.mean_power_low_w, "W")} to ${quantity(noise.mean_power_high_w, "W")}).`);
        if (robust) {
            const quantiles = (robust.quantiles as { share: number; mean_power_w: number }[]).map((one) => `${digits(100 * one.share, 2)} %: ${quantity(one.mean_power_w, "W")}`);
            found.push(`Power under the tolerances, quantiles of ${robust.draws} draws: ${quantiles.join(", ")}${robust.lost_fraction > 0 ? `; the orbit is lost in ${share(robust.lost_fraction)}` : ""}.`);
            const causes = (robust.sobol as { key: string; first: number; total: number }[]).map((one) => `${this.controls.title(one.key)} ${digits(one.first, 2)} alone, ${digits(one.total, 2)} in all`);
            found.push(`Share of the variance: ${causes.join("; ")}.`);
        }
        const ends: Record<string, string> = { converged: "nothing better is expected", evaluations: "the next step would exceed the number of evaluations" };
        found.push(`${evaluations} evaluations in ${digits(wall_time_s, 3)} s; ${ends[ended_by] ?? ended_by}.`);
        return found;
    }
}

function line(text: string): HTMLElement {
    const paragraph = document.createElement("p");
    paragraph.textContent = text;
    return paragraph;
}

/** A table; the first cell of each row is its header. */
function table(title: string, columns: string[], rows: string[][]): HTMLElement {
    const made = document.createElement("table");
    const caption = made.createCaption();
    caption.textContent = title;
    const cells = (names: string[], kind: (k: number) => "th" | "td", scope: string) => names.map((text, k) => {
        const cell = document.createElement(text === "" && kind(k) === "th" ? "td" : kind(k));
        if (cell.tagName === "TH") cell.setAttribute("scope", scope);
        cell.textContent = text;
        cell.classList.toggle("warning", text === NOT_MET);
        return cell;
    });
    made.createTHead().insertRow().append(...cells(columns, () => "th", "col"));
    const body = made.createTBody();
    for (const row of rows) body.insertRow().append(...cells(row, (k) => (k === 0 ? "th" : "td"), "row"));
    return made;
}
