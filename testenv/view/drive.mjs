// Drives a page in headless Chromium: one JSON command per line on standard input, one JSON answer
// per line on standard output. `node drive.mjs NODE_MODULES CHROMIUM`
import { createRequire } from "node:module";
import readline from "node:readline";

const [modules, chromium] = process.argv.slice(2);
const playwright = createRequire(modules + "/")("playwright-core");
const browser = await playwright.chromium.launch({
    executablePath: chromium, headless: true,
    args: ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-sandbox", "--disable-gpu-watchdog"]
});
let page = null, messages = [];

const commands = {
    async open({ url, width = 640, height = 480, touch = false, gl = true }) {
        await page?.context().close();
        messages = [];
        const context = await browser.newContext({
            viewport: { width, height }, hasTouch: touch, acceptDownloads: true, offline: true
        });
        page = await context.newPage();
        page.setDefaultTimeout(120000);
        page.on("console", m => messages.push(`${m.type()}: ${m.text()}`));
        page.on("pageerror", e => messages.push(`error: ${e.message}`));
        page.on("dialog", d => { messages.push(`dialog: ${d.message()}`); d.dismiss(); });
        page.on("request", r => { if (!/^(file|data|blob):/.test(r.url())) messages.push(`request: ${r.url()}`); });
        if (!gl) await page.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; });
        await page.goto(url);
    },
    evaluate: ({ code }) => page.evaluate(`(async () => { ${code} })()`),
    async screenshot({ path }) { await page.screenshot({ path }); },
    async press({ key }) { await page.keyboard.press(key); },
    async click({ selector }) { await page.click(selector); },
    async download({ selector, path }) {
        const [download] = await Promise.all([page.waitForEvent("download"), page.click(selector)]);
        await download.saveAs(path);
        return download.suggestedFilename();
    },
    messages: () => messages
};

for await (const line of readline.createInterface({ input: process.stdin })) {
    const command = JSON.parse(line);
    let answer;
    try {
        answer = { value: await commands[command.do](command) ?? null };
    } catch (error) {
        answer = { error: String(error.message ?? error).split("\n")[0] };
    }
    process.stdout.write(JSON.stringify(answer) + "\n");
}
await browser.close();
