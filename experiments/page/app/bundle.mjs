// Bundles src/ and the libraries it uses into one HTML file: node bundle.mjs OUT.html
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";

const [output] = process.argv.slice(2);
if (!output) throw new Error("usage: node bundle.mjs OUT.html");

const bundled = await build({
  entryPoints: ["src/main.ts"],
  outdir: "bundle",
  bundle: true,
  write: false,
  minify: true,
  charset: "ascii",
  format: "iife",
  target: ["chrome110", "firefox115", "safari16.4"],
  legalComments: "inline",
  logLevel: "warning",
});

const textOf = (ending) => {
  const file = bundled.outputFiles.find(({ path }) => path.endsWith(ending));
  if (!file) throw new Error(`esbuild made no ${ending}`);
  return file.text;
};

/** Puts `text` in the place of `mark`, which must be there once. */
function fill(page, mark, text) {
  const parts = page.split(mark);
  if (parts.length !== 2) throw new Error(`index.html must hold ${mark} once`);
  return parts.join(text);
}

let page = readFileSync("index.html", "utf8");
page = fill(page, "/*smopt:styles*/", textOf(".css"));
page = fill(page, "/*smopt:program*/", textOf(".js"));
for (const mark of ["<!--smopt:data-->", "<!--smopt:meshes-->"]) fill(page, mark, "");
writeFileSync(output, page);
