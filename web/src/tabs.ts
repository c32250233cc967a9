// Tabs with arrow keys, following the ARIA authoring practices.

export class Tabs {
    private readonly tabs: HTMLButtonElement[];

    constructor(list: HTMLElement, private readonly shown: (id: string) => void) {
        this.tabs = [...list.querySelectorAll<HTMLButtonElement>("[role=tab]")];
        this.tabs.forEach((tab, k) => {
            tab.onclick = () => this.choose(k);
            tab.onkeydown = (event) => {
                const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
                if (step === undefined) return;
                event.preventDefault();
                this.choose((k + step + this.tabs.length) % this.tabs.length);
            };
        });
    }

    private choose(chosen: number): void {
        this.tabs.forEach((tab, k) => {
            tab.setAttribute("aria-selected", String(k === chosen));
            tab.tabIndex = k === chosen ? 0 : -1;
            document.getElementById(tab.getAttribute("aria-controls")!)!.hidden = k !== chosen;
        });
        this.tabs[chosen].focus();
        this.shown(this.tabs[chosen].id);
    }
}
