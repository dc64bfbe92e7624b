// Searches the sections of all pages, which entries.js lists. Everything found is shown as text.
"use strict";
const input = document.querySelector("nav input");
const list = document.querySelector("nav ol");
const home = document.documentElement.dataset.home;
const most = 12;

// How well a section fits: all words must occur; those in its heading count more. 0: not at all.
function fit(entry, words) {
  let sum = 0;
  for (const word of words) {
    if (entry.heading.toLowerCase().includes(word) || entry.page.toLowerCase().includes(word)) sum += 10;
    else if (entry.text.toLowerCase().includes(word)) sum += 1;
    else return 0;
  }
  return sum;
}

// Some words around the first place where one of them occurs.
function excerpt(text, words) {
  const small = text.toLowerCase();
  const places = words.map((word) => small.indexOf(word)).filter((place) => place >= 0);
  const begin = places.length ? Math.max(0, Math.min(...places) - 40) : 0;
  return (begin > 0 ? "…" : "") + text.slice(begin, begin + 140) + (begin + 140 < text.length ? "…" : "");
}

function row(entry, words) {
  const item = document.createElement("li");
  const link = document.createElement("a");
  link.href = home + entry.url;
  link.textContent = entry.heading === entry.page ? entry.page : `${entry.page}: ${entry.heading}`;
  const sample = document.createElement("small");
  sample.textContent = excerpt(entry.text, words);
  link.append(sample);
  item.append(link);
  return item;
}

function search() {
  const words = input.value.toLowerCase().split(/\s+/).filter((word) => word);
  const found = words.length
    ? entries.map((entry) => ({ entry, points: fit(entry, words) })).filter((one) => one.points > 0)
    : [];
  found.sort((a, b) => b.points - a.points);
  list.replaceChildren(...found.slice(0, most).map((one) => row(one.entry, words)));
  if (words.length && !found.length) {
    const item = document.createElement("li");
    item.textContent = "Nothing found.";
    list.replaceChildren(item);
  }
}

input.addEventListener("input", search);
input.addEventListener("keydown", (event) => {
  if (event.key === "Escape") { input.value = ""; search(); }
  if (event.key === "Enter" && list.querySelector("a")) list.querySelector("a").click();
});
