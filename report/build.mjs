// Bundles src/ and the parts of Plotly it uses into dist/: report.js, report.css, LICENSES.txt, and sources.json by
// which a test sees that dist/ is up to date.
import {build} from "esbuild";
import {createHash} from "node:crypto";
import {existsSync, readdirSync, readFileSync, writeFileSync} from "node:fs";

// Plotly can offer to send a chart to its maker's server: the button is off (src/figures.ts), and the dialogue it would
// open is left out here.
const nothingIsSent = {
  name: "nothing-is-sent",
  setup(build) {
    build.onLoad({filter: /share_chart[\\/]dialog\.js$/}, () => ({contents: "module.exports = () => {};"}));
  },
};
const bundle = await build({
  entryPoints: {report: "src/main.ts"},
  outdir: "dist",
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome109", "firefox115", "safari16"],
  define: {global: "window"},
  legalComments: "none",
  charset: "utf8",
  // Plotly's map traces, which are not used, want a style sheet of their own
  loader: {".css": "empty"},
  plugins: [nothingIsSent],
  metafile: true,
});
await build({entryPoints: {report: "src/page.css"}, outdir: "dist", minify: true, charset: "utf8"});

// The closing tag of a script must not occur inside one.
const script = readFileSync("dist/report.js", "utf8");
if (/<\/script|<!--/i.test(script)) throw new Error("the bundle holds a text that would end its script element");

const packages = new Set();
for (const [file, part] of Object.entries(Object.values(bundle.metafile.outputs)[0].inputs)) {
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
writeFileSync("dist/LICENSES.txt", licences);

const sources = [
  "package.json", "package-lock.json", "tsconfig.json", "build.mjs",
  ...readdirSync("src").sort().map((file) => `src/${file}`)
].filter(existsSync);
const sha256 = (file) => createHash("sha256").update(readFileSync(file)).digest("hex");
const hashes = Object.fromEntries(
    [...sources, "dist/report.js", "dist/report.css", "dist/LICENSES.txt"].map((file) => [file, sha256(file)]));
writeFileSync("dist/sources.json", JSON.stringify(hashes, null, 2) + "\n");
console.log(`dist/report.js ${(script.length / 1e6).toFixed(2)} MB, ${packages.size} packages`);
