// The design: overrides of the file, with undo, redo and a link that stores them all.

export type Overrides = ReadonlyMap<string, string>;

export interface View {
    over: string;
    from: number;
    to: number;
}

export class Design {
    private present: Map<string, string> = new Map();
    private settled: Map<string, string> = new Map();
    private version = 0;
    private readonly past: Map<string, string>[] = [];
    private readonly future: Map<string, string>[] = [];
    /** Called after every change; `moving` while a slider or handle is held. */
    onChange: (moving: boolean) => void = () => {};

    get overrides(): Overrides {
        return this.present;
    }

    get pairs(): [string, string][] {
        return [...this.present];
    }

    /** Text that is equal for equal designs; a change of the file makes a new one. */
    get signature(): string {
        return JSON.stringify([this.version, [...this.present].sort()]);
    }

    /** A signature, of the present design by default, without one key. */
    signatureWithout(key: string, signature = this.signature): string {
        const [version, pairs] = JSON.parse(signature) as [number, [string, string][]];
        return JSON.stringify([version, pairs.filter(([own]) => own !== key)]);
    }

    /** True where a result over a key belongs to an earlier design: such a result does not depend on the value of the key itself. */
    isOld({ design, over }: { design: string; over: string }): boolean {
        return this.signatureWithout(over, design) !== this.signatureWithout(over);
    }

    /** Registers a change of the file. */
    fileChanged(): void {
        this.version++;
    }

    get canUndo(): boolean {
        return this.past.length > 0 || !this.isSettled;
    }

    get canRedo(): boolean {
        return this.future.length > 0;
    }

    /** Starts with an empty history. */
    begin(pairs: [string, string][]): void {
        this.present = new Map(pairs);
        this.settled = new Map(pairs);
        this.past.length = this.future.length = 0;
    }

    /** Sets a key; while `moving` nothing is stored for undo. */
    set(key: string, value: string, moving = false): void {
        this.setAll([[key, value]], moving);
    }

    setAll(pairs: [string, string][], moving = false): void {
        const before = pairs.every(([key, value]) => this.present.get(key) === value);
        if (before && moving) return;
        this.present = new Map(this.present);
        for (const [key, value] of pairs) this.present.set(key, value);
        if (!moving) this.settle();
        this.onChange(moving);
    }

    /** Restores the value of the file for a key. */
    restore(key: string): void {
        this.replace(this.pairs.filter(([own]) => own !== key));
    }

    reset(): void {
        this.replace([]);
    }

    /** Replaces the whole design; undo restores the previous one. */
    replace(pairs: [string, string][]): void {
        this.present = new Map(pairs);
        this.settle();
        this.onChange(false);
    }

    /** Returns to the last design that was settled, or to the one before. */
    undo(): void {
        if (this.isSettled) return this.travel(this.past, this.future);
        this.future.push(this.present);
        this.present = new Map(this.settled);
        this.onChange(false);
    }

    redo(): void {
        this.travel(this.future, this.past);
    }

    private travel(from: Map<string, string>[], to: Map<string, string>[]): void {
        const found = from.pop();
        if (!found) return;
        to.push(this.settled);
        this.present = new Map(found);
        this.settled = found;
        this.onChange(false);
    }

    private get isSettled(): boolean {
        return this.settled.size === this.present.size && this.pairs.every(([key, value]) => this.settled.get(key) === value);
    }

    private settle(): void {
        if (this.isSettled) return;
        this.past.push(this.settled);
        this.future.length = 0;
        this.settled = new Map(this.present);
    }
}

/** The fragment with a design, its range, and what the page shows of it. */
export function toFragment(pairs: [string, string][], view: View | undefined, page: [string, string][]): string {
    const words = new URLSearchParams();
    for (const [key, value] of pairs) words.append("set", `${key}=${value}`);
    if (view) {
        words.set("over", view.over);
        words.set("from", String(view.from));
        words.set("to", String(view.to));
    }
    for (const [name, value] of page) words.set(name, value);
    return words.toString();
}

/** Fields of a fragment that are its design and its range. */
const DESIGN_FIELDS = ["set", "over", "from", "to"];

/** The design in a fragment with its range, if it has one, and the other fields. */
export function fromFragment(fragment: string): { design: { pairs: [string, string][]; view: View | undefined } | undefined; page: [string, string][] } {
    const words = new URLSearchParams(fragment.replace(/^#/, ""));
    const pairs = words.getAll("set").filter((text) => text.includes("=")).map((text): [string, string] => {
        const split = text.indexOf("=");
        return [text.slice(0, split), text.slice(split + 1)];
    });
    const over = words.get("over");
    const [from, to] = [Number(words.get("from")), Number(words.get("to"))];
    const view = over && from < to ? { over, from, to } : undefined;
    const page = [...words].filter(([name, value]) => !DESIGN_FIELDS.includes(name) && value !== "");
    return { design: pairs.length > 0 || view ? { pairs, view } : undefined, page };
}
