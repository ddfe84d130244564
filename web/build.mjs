// Bundles src/ into dist/: the report's page (report.js, report.css), the explorer's (explore.js, explore.css and
// worker.js: the engine's own script, dist/engine.js, and the worker behind it), and sources.json by which a test sees
// that dist/ is up to date. The engine itself comes from engine/build_engine.py.
import {build} from "esbuild";
import {createHash} from "node:crypto";
import {readdirSync, readFileSync, writeFileSync} from "node:fs";

// Plotly can offer to send a chart to its maker's server: the button is off (src/report/figures.ts), and the dialogue it
// would open is left out here.
const nothingIsSent = {
  name: "nothing-is-sent",
  setup(build) {
    build.onLoad({filter: /share_chart[\\/]dialog\.js$/}, () => ({contents: "module.exports = () => {};"}));
  },
};
const script = {bundle: true, minify: true, format: "iife", target: ["chrome109", "firefox115", "safari16"],
                legalComments: "none", charset: "utf8"};
const bundle = await build({
  ...script,
  entryPoints: {report: "src/report/main.ts", explore: "src/explore/main.ts"},
  outdir: "dist",
  define: {global: "window"},
  // Plotly's map traces, which are not used, want a style sheet of their own
  loader: {".css": "empty"},
  plugins: [nothingIsSent],
  metafile: true,
});
await build({entryPoints: {report: "src/report/page.css", explore: "src/explore/explore.css"}, outdir: "dist",
             minify: true, charset: "utf8"});
const worker = await build({...script, entryPoints: ["src/explore/worker.ts"], write: false});
const glue = readFileSync("dist/engine.js", "utf8");
writeFileSync("dist/worker.js", `${glue}\n${worker.outputFiles[0].text}`);

// The closing tag of a script must not occur inside one.
for (const file of ["report.js", "explore.js", "worker.js"])
  if (/<\/script|<!--/i.test(readFileSync(`dist/${file}`, "utf8")))
    throw new Error(`dist/${file} holds a text that would end its script element`);

const packages = new Set();
for (const [file, part] of Object.entries(bundle.metafile.outputs["dist/report.js"].inputs)) {
  const path = file.split("node_modules/").slice(1).pop();
  if (!path || path.endsWith(".css") || part.bytesInOutput === 0) continue;
  const name = path.split("/").slice(0, path.startsWith("@") ? 2 : 1).join("/");
  packages.add(file.slice(0, file.lastIndexOf(path)) + name);
}

function withoutText(author) {
  const holder = typeof author === "object" ? author.name : author;
  return `Copyright ${holder}. The package brings no text of its licence; the one named above applies.`;
}

let licences = "Third-party software in report.js, with its licences.\n";
for (const folder of [...packages].sort()) {
  const {name, version, license, author} = JSON.parse(readFileSync(`${folder}/package.json`, "utf8"));
  const text = readdirSync(folder).find((file) => /^licen[cs]e/i.test(file));
  const kind = typeof license === "object" ? license.type : license;
  const body = text ? readFileSync(`${folder}/${text}`, "utf8").trim() : withoutText(author);
  licences += `\n${"=".repeat(80)}\n${name} ${version} (${kind})\n\n${body}\n`;
}
writeFileSync("dist/report_licences.txt", licences);

const below = (folder) => readdirSync(folder, {recursive: true, withFileTypes: true}).filter((e) => e.isFile())
                              .map((e) => `${e.parentPath ?? e.path}/${e.name}`).sort();
const sources = ["package.json", "package-lock.json", "tsconfig.json", "build.mjs", ...below("src")];
const made = below("dist").filter((file) => !file.endsWith("sources.json"));
const sha256 = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const hashes = Object.fromEntries([...sources, ...made].map((file) => [file, sha256(file)]));
writeFileSync("dist/sources.json", JSON.stringify(hashes, null, 2) + "\n");
for (const file of ["report.js", "explore.js"])
  console.log(`dist/${file} ${(readFileSync(`dist/${file}`).length / 1e6).toFixed(2)} MB`);
