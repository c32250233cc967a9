// The design problem: free keys with their ranges, the goal, limits and tolerances.

import type { Control, Controls } from "./controls";
import type { Head } from "./frame";
import { type FieldFault, type Fields, Rows, type StoredRow, check, field, put, withUnit } from "./rows";
import { tabStorage } from "./storage";
import { digits, quantity, sign } from "./units";

/** A limit that the harvester allows. */
export interface AllowedLimit {
    name: string;
    example: string;
    unit: string;
    factor: number;
}

interface Goal {
    name: string;
    unit: string;
    needs_starts: boolean;
}

const find = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const STORE = `jounce-design-problem ${location.pathname}`;
/** Fields that are not in rows. */
const FIELDS = ["search-goal", "search-starts", "search-evaluations", "search-seed"];

interface Stored {
    rows: StoredRow[][];
    texts: string[];
    robust: boolean;
}

/** Goal that needs no periodic orbits. */
const MEAN_POWER = "mean-power";
/** Share of a value that is offered as its tolerance. */
const TOLERANCE = 0.05;

export class Problem {
    readonly free: Rows;
    readonly limits: Rows;
    readonly tolerance: Rows;
    private readonly goal = find<HTMLSelectElement>("search-goal");
    private goals: Goal[] = [];
    /** False where the drives have no common period, so that only a mean over time can be a goal. */
    periodic = true;
    private allowed: AllowedLimit[] = [];

    constructor(private readonly controls: Controls) {
        this.free = new Rows(find("search-free"), "free", "free key", (key, describe) => this.range(key, describe));
        this.limits = new Rows(find("search-limits"), "limits", "limit", (name, describe) => this.limit(name, describe));
        this.tolerance = new Rows(find("search-tolerance"), "tolerance", "tolerance", (key, describe) => this.scatter(key, describe));
        this.goal.onchange = () => this.needStarts();
        this.restore();
        for (const kind of ["input", "change"]) find("search-form").addEventListener(kind, () => this.store());
    }

    private get tables(): Rows[] {
        return [this.free, this.limits, this.tolerance];
    }

    /** Stores the problem until the tab is closed. */
    private store(): void {
        const texts = FIELDS.map((id) => find<HTMLInputElement>(id).value);
        const stored: Stored = { rows: this.tables.map((rows) => rows.state), texts, robust: find<HTMLInputElement>("robust").checked };
        tabStorage?.setItem(STORE, JSON.stringify(stored));
    }

    /** Shows the problem from before the page was loaded again. */
    private restore(): void {
        const text = tabStorage?.getItem(STORE);
        if (!text) return;
        const { rows, texts, robust } = JSON.parse(text) as Stored;
        this.tables.forEach((table, k) => table.restore(rows[k]));
        // The goals of the harvester are offered later.
        this.goal.replaceChildren(new Option(texts[0], texts[0]));
        FIELDS.forEach((id, k) => (find<HTMLInputElement>(id).value = texts[k]));
        find<HTMLInputElement>("robust").checked = robust;
    }

    /** Offers the keys of the present design. */
    offerKeys(): void {
        const keys = this.controls.all.map(({ key }): [string, string] => [key, this.controls.title(key)]);
        this.free.offer(keys);
        this.tolerance.offer(this.controls.all.filter(({ count }) => !count).map(({ key }): [string, string] => [key, this.controls.title(key)]));
    }

    /** Offers the goals and limits that the harvester can have. */
    offer({ goals, limits }: Head): void {
        [this.goals, this.allowed] = [goals, limits];
        if ([...this.goal.options].map((option) => option.value).join() !== this.goals.map((goal) => goal.name).join()) {
            const chosen = this.goal.value;
            this.goal.replaceChildren(...this.goals.map(({ name }) => new Option(name.replaceAll("-", " "), name, false, name === chosen)));
        }
        const isPossible = this.periodic || !this.goals.find(({ name }) => name === this.goal.value)?.needs_starts;
        if (!isPossible) this.goal.value = MEAN_POWER;
        this.limits.offer(this.allowed.map(({ name }): [string, string] => [name, limitTitle(name)]));
        this.needStarts();
    }

    private needStarts(): void {
        find<HTMLInputElement>("search-starts").disabled = !(this.goals.find((goal) => goal.name === this.goal.value)?.needs_starts ?? true);
    }

    /** The fields as the server takes them. */
    get fields(): object {
        const text = (id: string) => find<HTMLInputElement>(id).value;
        return {
            free: this.free.pairs, limits: this.limits.pairs, tolerance: this.tolerance.pairs, maximise: this.goal.value,
            starts: text("search-starts"), evaluations: text("search-evaluations"), seed: text("search-seed"),
        };
    }

    /** Shows faults at their fields, and those of no field above all. */
    tell(faults: FieldFault[]): void {
        let rest = faults;
        for (const rows of this.tables) rest = rows.tell(rest);
        const places = { maximise: "goal", starts: "starts", evaluations: "evaluations", seed: "seed" };
        const goal = rest.filter(({ key }) => key in places);
        for (const [key, id] of Object.entries(places)) find(`search-${id}`).setAttribute("aria-invalid", String(goal.some((fault) => fault.key === key)));
        put(find("search-goal-fault"), goal.map(({ message }) => message));
        put(find("search-faults"), rest.filter((fault) => !goal.includes(fault)).map(({ message }) => message));
    }

    /** A value of a goal with its unit. */
    goalText(name: string, value: number): string {
        return quantity(value, this.goals.find((goal) => goal.name === name)?.unit ?? "W");
    }

    /** Name of the goal of the fields. */
    get goalName(): string {
        return this.goal.value;
    }

    /** A value of a limit with its unit. */
    limitText(name: string, value: number): string {
        const { unit, factor } = this.limitOf(name);
        return unit === "ppm" ? `${digits(value / factor)} ppm` : quantity(value, unit);
    }

    /** The price of a limit: power for one more unit of it. */
    priceText(name: string, price: number): string {
        const { unit, factor } = this.limitOf(name);
        return `${quantity(price * factor, "W", 3)} per ${sign(unit) || "unit"}`;
    }

    private limitOf(name: string): AllowedLimit {
        return this.allowed.find((limit) => limit.name === name) ?? { name, example: "", unit: "", factor: 1 };
    }

    private range(key: string, describe: string): Fields {
        const control = this.controls.find(key)!;
        const title = this.controls.title(key);
        const [from, to] = [control.from, control.to].map((end) => digits(end / control.factor, 4));
        const low = field(`${title}, from`, from, describe, 5);
        const high = field(`${title}, to`, to, describe, 5);
        const { label, box } = check("log", `${title}, logarithmic`, control.scale === "log");
        const ends = () => [low, high].map((end) => withUnit(end.value, control.unit)).join(":");
        return { parts: [low, words("to"), high, words(sign(control.unit), "unit"), label], read: () => ends() + (box.checked ? ":log" : "") };
    }

    private limit(name: string, describe: string): Fields {
        const { example } = this.limitOf(name);
        const [text, origin] = this.firstLimit(name);
        const value = field(`${limitTitle(name)}, limit`, text, describe, 10);
        return { parts: [value, words(`${text}: ${origin}`)], read: () => withUnit(value.value, example.replace(/^[-+.\deE]+\s*/, "")) };
    }

    /** The first value of a limit, and its origin: the limit of the patch, or else an example. */
    private firstLimit(name: string): [string, string] {
        const { example, unit, factor } = this.limitOf(name);
        const control = this.controls.find(`${name}_limit`);
        if (!control) return [example, "only an example"];
        const text = `${digits(control.value / factor)} ${unit}`;
        return [text, control.written ? "strain limit of the spec" : "recommended for the material of the patch"];
    }

    private scatter(key: string, describe: string): Fields {
        const control: Control = this.controls.find(key)!;
        const title = this.controls.title(key);
        const value = field(`${title}, tolerance`, digits(Math.abs((TOLERANCE * control.value) / control.factor), 2), describe, 6);
        const { label, box } = check("normal", `${title}, normal distribution`, false);
        return { parts: [words("±"), value, words(sign(control.unit), "unit"), label], read: () => withUnit(value.value, control.unit) + (box.checked ? " normal" : "") };
    }
}

/** Words of a limit, "patch mfc strain". */
function limitTitle(name: string): string {
    const text = name.replaceAll(".", " ").replaceAll("_", " ");
    return text[0].toUpperCase() + text.slice(1);
}

function words(text: string, kind = "words"): HTMLElement {
    const span = document.createElement("span");
    span.className = kind;
    span.textContent = text;
    return span;
}
