// Pinned designs: their responses remain on the chart, also after the page is loaded again.

import type { Branch, ResponseResult } from "./branches";
import type { Design } from "./design";
import type { Response } from "./response";
import { tabStorage } from "./storage";
import { nth } from "./theme";

const MOST = 4;
const STORE = `jounce-pins ${location.pathname}`;

interface Pin {
    words: string;
    pairs: [string, string][];
    result: ResponseResult;
    /** Number of its colour, which it retains. */
    colour: number;
}

export class Pins {
    private kept: Pin[] = stored();

    constructor(private readonly host: HTMLElement, private readonly response: Response, private readonly design: Design, private readonly reply: (words: string) => void) {
        this.show();
    }

    add(): void {
        const { result } = this.response;
        if (!result) return;
        if (this.kept.length === MOST) return this.reply(`at most ${MOST} pins; remove one first`);
        const words = this.design.pairs.map(([key, value]) => `${key.split(".").slice(1).join(" ")} ${value}`).join(", ") || "as in the file";
        const colour = [2, 3, 4, 5].find((own) => this.kept.every((pin) => pin.colour !== own))!;
        this.kept.push({ words, pairs: this.design.pairs, result, colour });
        this.show();
    }

    private show(): void {
        tabStorage?.setItem(STORE, JSON.stringify(this.kept, (_, value) => (value instanceof Float64Array ? [...value] : value)));
        this.response.pins = this.kept;
        this.host.replaceChildren(...this.kept.map((pin) => this.item(pin)));
        this.mark();
        this.response.draw();
    }

    /** Shows which pins are on the chart: those over its key. */
    mark(): void {
        const over = this.response.result?.over;
        [...this.host.children].forEach((item, k) => {
            const other = over !== undefined && this.kept[k].result.over !== over;
            item.classList.toggle("stale", other);
            item.querySelector("span")!.textContent = other ? `over ${this.kept[k].result.over}` : "";
        });
    }

    private item(pin: Pin): HTMLElement {
        const item = document.createElement("li");
        item.style.setProperty("--own", nth(pin.colour));
        const back = document.createElement("button");
        back.textContent = pin.words;
        back.title = `Restore this design: ${pin.words}`;
        back.onclick = () => this.design.replace(pin.pairs);
        const remove = document.createElement("button");
        remove.textContent = "×";
        remove.setAttribute("aria-label", `Unpin ${pin.words}`);
        remove.onclick = () => {
            this.kept = this.kept.filter((own) => own !== pin);
            this.show();
        };
        item.append(back, remove, document.createElement("span"));
        return item;
    }
}

/** The pins before the page was loaded again. */
function stored(): Pin[] {
    const pins = JSON.parse(tabStorage?.getItem(STORE) ?? "[]") as Pin[];
    const numbers = (list: ArrayLike<number>) => Float64Array.from(list);
    for (const { result } of pins) {
        result.linear = { x: numbers(result.linear.x), power: numbers(result.linear.power) };
        for (const branch of result.branches) {
            [branch.x, branch.contacts] = [numbers(branch.x), numbers(branch.contacts)];
            branch.values = Object.fromEntries(Object.entries(branch.values).map(([name, list]) => [name, numbers(list)])) as Branch["values"];
        }
    }
    return pins;
}
