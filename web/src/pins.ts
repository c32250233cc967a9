// Pinned designs: their responses remain on the chart.

import type { Design } from "./design";
import type { Response } from "./response";

const MOST = 4;

export class Pins {
    private readonly kept: { words: string; pairs: [string, string][]; result: NonNullable<Response["result"]> }[] = [];

    constructor(private readonly host: HTMLElement, private readonly response: Response, private readonly design: Design) {}

    add(): void {
        const { result } = this.response;
        if (!result) return;
        const words = this.design.pairs.map(([key, value]) => `${key.split(".").slice(1).join(" ")} ${value}`).join(", ") || "as in the file";
        this.kept.push({ words, pairs: this.design.pairs, result });
        if (this.kept.length > MOST) this.kept.shift();
        this.show();
    }

    private show(): void {
        this.response.pins = this.kept.map(({ result, words }) => ({ result, words }));
        this.host.replaceChildren(
            ...this.kept.map((pin, k) => {
                const item = document.createElement("li");
                item.dataset.colour = String((k + 2) % 6);
                const back = document.createElement("button");
                back.textContent = pin.words;
                back.title = "Restore this design";
                back.onclick = () => {
                    this.design.begin(pin.pairs);
                    this.design.onChange(false);
                };
                const remove = document.createElement("button");
                remove.textContent = "×";
                remove.setAttribute("aria-label", `Unpin ${pin.words}`);
                remove.onclick = () => {
                    this.kept.splice(k, 1);
                    this.show();
                };
                item.append(back, remove);
                return item;
            }),
        );
        this.response.draw();
    }
}
