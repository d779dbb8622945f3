// node in_a_browser.mjs APP CHROMIUM PAGES: opens made pages (make_page.cpp) from files, clicks through them, and ends with 1 when one of them does
// not do what it should, writes an error to the console, or asks for anything from a network.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [app, executablePath, pages] = process.argv.slice(2);
const { chromium } = createRequire(join(app, "package.json"))("playwright-core");

const kBrowserOptions = [
  "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
const kPatience = 30_000; // milliseconds, for anything that should happen
const kSettled = 900; // after which a flight of the camera has ended

const problems = [];
const browser = await chromium.launch({ executablePath, args: kBrowserOptions });

/** Opens DIR/report.html; whatever goes wrong from then on is kept in `problems`. */
async function open(folder, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 900 }, ...options });
  page.setDefaultTimeout(kPatience);
  page.on("console", (message) => ["error", "warning"].includes(message.type()) && problems.push(`${folder}: console: ${message.text()}`));
  page.on("pageerror", (error) => problems.push(`${folder}: ${error.stack ?? error}`));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`${folder}: asked for ${request.url()}`));
  page.on("dialog", (dialog) => (problems.push(`${folder}: a dialog: ${dialog.message()}`), dialog.dismiss()));
  await page.goto(pathToFileURL(join(pages, folder, "report.html")).href);
  return page;
}

async function test(name, run) {
  try {
    await run();
    console.log(`ok      ${name}`);
  } catch (error) {
    console.log(`FAILED  ${name}`);
    problems.push(`${name}: ${error.stack ?? error}`);
  }
}

const meshesAreShown = (page) => page.waitForFunction(() => document.querySelector("#lists-right .jump") && document.querySelector(".loading")?.textContent === "");

/** A picture of the stage, once nothing moves any more. */
async function stagePicture(page) {
  await page.waitForTimeout(kSettled);
  return page.locator("#stage").screenshot();
}

async function changesTheStage(page, action) {
  const before = await stagePicture(page);
  await action();
  assert.notDeepEqual(await stagePicture(page), before, "the stage shows the same as before");
}

async function changesTheChart(page, id, action) {
  const before = await page.locator(id).innerHTML();
  await action();
  await page.waitForFunction(([selector, old]) => document.querySelector(selector).innerHTML !== old, [id, before]);
}

const textsOfColumn = (page, table, field) => page.locator(`#table-${table} .tabulator-row .tabulator-cell[tabulator-field="${field}"]`).allTextContents();

/** The field of the column with this head. */
const fieldOf = (page, table, title) =>
  page.locator(`#table-${table} .tabulator-col`, { hasText: title }).first().getAttribute("tabulator-field");

const page = await open("run");

await test("the summary names molecules, methods, and what failed with its reason", async () => {
  const summary = page.locator("#summary");
  assert.match(await summary.textContent(), /The ball \(stand-in\)/);
  assert.deepEqual(await page.locator("#summary-methods tbody th").allTextContents(), ["initial", "SMOPT", "plain Laplacian", "MeshLab"]);
  const failures = await page.locator("#summary-failures tbody tr").allTextContents();
  assert.equal(failures.length, 2);
  assert.ok(failures.some((text) => text.includes('failed: gave "</script><script>window.broken = true</script><img src=x')), failures.join("\n"));
  assert.ok(failures.some((text) => text.includes("diverged at step 12")));
});

await test("what looks like markup in the data is only shown", async () => {
  assert.equal(await page.evaluate(() => "broken" in window), false);
  assert.equal(await page.locator("img").count(), 0);
});

await test("a click on a head sorts the table by numbers, down and up", async () => {
  const field = await fieldOf(page, "methods", "Vertices");
  const numbers = async () => (await textsOfColumn(page, "methods", field)).filter((text) => text !== "—").map((text) => Number(text.replaceAll("\u202f", "")));
  const unsorted = await numbers();
  assert.ok(unsorted.length >= 6);
  const ascending = [...unsorted].sort((a, b) => a - b);
  const head = page.locator(`#table-methods .tabulator-col[tabulator-field="${field}"] .tabulator-col-title`);
  await head.click();
  assert.deepEqual(await numbers(), ascending);
  await head.click();
  assert.deepEqual(await numbers(), ascending.reverse());
});

await test("a table is filtered by text", async () => {
  const rows = page.locator("#table-methods .tabulator-row");
  const all = await rows.count();
  await page.fill("#search-methods", "plain laplacian");
  await page.waitForFunction(() => document.querySelectorAll("#table-methods .tabulator-row").length === 2);
  await page.fill("#search-methods", "");
  await page.waitForFunction((count) => document.querySelectorAll("#table-methods .tabulator-row").length === count, all);
});

await test("figures follow their choosers", async () => {
  await changesTheChart(page, "#chart-sizes", () => page.selectOption("#sizes-quantity", "volume"));
  await changesTheChart(page, "#chart-sizes", () => page.selectOption("#sizes-scale", "change"));
  await changesTheChart(page, "#chart-ratios", () => page.selectOption("#ratios-molecule", "ring"));
  await changesTheChart(page, "#chart-angles", () => page.selectOption("#angles-molecule", "ring"));
  await changesTheChart(page, "#chart-angles", () => page.selectOption("#angles-scale", "share"));
  for (const quantity of ["below30", "pairs", "level-set", "volume", "area", "time", "angle"])
    await changesTheChart(page, "#chart-comparison", () => page.selectOption("#comparison-quantity", quantity));
});

await test("a figure says which case it cannot show, and why", async () => {
  const text = await page.locator("#figures").textContent();
  assert.match(text, /Without bars: .*The ring, plain Laplacian: failed/);
  assert.match(text, /The ring, MeshLab \(diverged\)/);
});

await test("the stage shows initial and SMOPT side by side, and another method when it is chosen", async () => {
  await meshesAreShown(page);
  await page.locator("#stage").scrollIntoViewIfNeeded();
  assert.equal(await page.inputValue("#mesh-left"), "initial");
  assert.equal(await page.inputValue("#mesh-right"), "smopt");
  await changesTheStage(page, async () => {
    await page.selectOption("#mesh-right", "laplacian");
    await meshesAreShown(page);
  });
});

await test("colours, edges and marks can be changed", async () => {
  await changesTheStage(page, () => page.selectOption("#mesh-measure", "edge_ratio"));
  assert.match(await page.locator("#lists-left .worst h4").textContent(), /edge ratio/);
  await changesTheStage(page, () => page.selectOption("#mesh-colours", "viridis"));
  await changesTheStage(page, () => page.uncheck("#mesh-edges"));
  await changesTheStage(page, () => page.uncheck("#mesh-pairs"));
  await page.check("#mesh-edges");
  await page.check("#mesh-pairs");
});

await test("a jump to a worst triangle moves both panes and tells of it", async () => {
  const first = page.locator("#lists-left .worst .jump").first();
  await changesTheStage(page, () => first.click());
  assert.equal(await first.getAttribute("aria-current"), "true");
  assert.match(await page.locator("#lists-left .picked").textContent(), /smallest angle .*largest angle .*edge ratio/);
});

await test("a jump to an intersecting pair shows it red and yellow", async () => {
  assert.match(await page.locator("#lists-right .pairs h4").textContent(), /Intersecting pairs: \d/);
  await changesTheStage(page, () => page.locator("#lists-right .pairs .jump").first().click());
  const { red, yellow } = await coloursShown(page);
  assert.ok(red > 50 && yellow > 50, `${red} red and ${yellow} yellow pixels`);
});

/** How many pixels of the stage have the two colours of a pair. */
async function coloursShown(page) {
  const picture = (await stagePicture(page)).toString("base64");
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const pixels = context.getImageData(0, 0, image.width, image.height).data;
    let red = 0;
    let yellow = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i] > 200 && pixels[i + 2] < 60 && pixels[i + 1] < 50) ++red;
      if (pixels[i] > 200 && pixels[i + 2] < 60 && pixels[i + 1] > 170) ++yellow;
    }
    return { red, yellow };
  }, picture);
}

await test("the stage is turned, zoomed and reset by keys, and a click tells of a triangle", async () => {
  await page.click("#mesh-reset");
  await page.locator("#stage canvas").focus();
  await changesTheStage(page, () => page.keyboard.press("ArrowLeft"));
  await changesTheStage(page, () => page.keyboard.press("+"));
  await changesTheStage(page, () => page.keyboard.press("Home"));
  const box = await page.locator("#stage").boundingBox();
  await changesTheStage(page, () => page.mouse.click(box.x + box.width / 4, box.y + box.height / 2));
  assert.match(await page.locator("#lists-left .picked").textContent(), /longest edge/);
});

await test("another molecule is shown, and the mesh that there is not is listed with its reason", async () => {
  await changesTheStage(page, async () => {
    await page.selectOption("#mesh-molecule", "ring");
    await meshesAreShown(page);
  });
  const options = await page.locator("#mesh-right option").allTextContents();
  assert.ok(options.some((text) => text.startsWith("plain Laplacian: gave ")), options.join("\n"));
  await page.selectOption("#mesh-right", "meshlab");
  await page.waitForFunction(() => document.querySelectorAll(".pane-head .note")[1].textContent.includes("not drawn"));
});

await test("everything can be reached by the Tab key", async () => {
  const reached = new Set();
  await page.locator("#mesh-molecule").focus();
  for (let i = 0; i < 14; ++i) {
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.className || document.activeElement.tagName));
    await page.keyboard.press("Tab");
  }
  for (const id of ["mesh-molecule", "mesh-measure", "mesh-edges", "mesh-reset", "mesh-left", "mesh-right", "CANVAS", "jump"])
    assert.ok(reached.has(id), `${id} is not among ${[...reached].join(", ")}`);
});

await test("nothing is wider than the window, and provenance stands at the foot", async () => {
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  assert.match(await page.locator("#provenance").textContent(), /Version\d.*Compiler\S+.*Machine\S+/);
});
await page.close();

await test("a run without meshes says so, and in the dark the page is dark", async () => {
  const bare = await open("bare", { colorScheme: "dark" });
  assert.match(await bare.locator("#no-meshes").textContent(), /no meshes/);
  assert.equal(await bare.locator("#stage").count(), 0);
  const background = await bare.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number));
  assert.ok(Math.max(...background) < 60, `the background is ${background}`);
  await bare.close();
});

await test("a mesh that is too large is shown in part, and the page says so", async () => {
  const large = await open("large");
  await meshesAreShown(large);
  assert.match(await large.locator("#shown-part").textContent(), /too large to be shown whole/);
  assert.match(await large.locator(".pane-head .note").first().textContent(), /400 of them shown/);
  assert.match(await large.locator("#lists-left .worst h4").textContent(), /of the part shown/);
  await large.close();
});

await browser.close();
for (const problem of problems) console.log(`\n${problem}`);
process.exit(problems.length > 0 ? 1 : 0);
