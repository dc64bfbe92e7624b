'use strict';
// The page of `rex watch --open`: shows the parts that the program sends when they change, and asks it for hints. Texts
// in the parts are escaped by the program, and the policy of the page lets no script of theirs run.
(function () {
  const state = document.getElementById('state');
  const shown = new Map();

  // Replaces a part. What is open in it stays open, and a replay is loaded when it is opened.
  function show(id, html) {
    if (shown.get(id) === html) return;
    shown.set(id, html);
    const part = document.getElementById(id);
    const open = new Set([...part.querySelectorAll('details[open]')].map(one => one.dataset.key));
    part.innerHTML = html;
    for (const one of part.querySelectorAll('details')) {
      one.addEventListener('toggle', () => load(one));
      one.open = open.has(one.dataset.key);
    }
  }
  function load(details) {
    const frame = details.querySelector('iframe[data-src]');
    if (details.open && frame && !frame.src) frame.src = frame.dataset.src;
  }

  function setState(text, kind) {
    state.textContent = text;
    state.className = kind;
  }

  async function copy(text) {
    try {
      await navigator.clipboard.writeText(text);
      setState('copied: ' + text, '');
    } catch (cause) {
      window.prompt('Copy this:', text);
    }
  }
  async function ask(part) {
    const answer = await fetch('events', { method: 'POST', body: JSON.stringify({ hint: part }) }).catch(() => null);
    if (!answer || !answer.ok) setState('The program does not answer.', 'lost');
  }
  document.addEventListener('click', ({ target }) => {
    const button = target.closest('button');
    if (!button) return;
    if (button.dataset.copy) copy(button.dataset.copy);
    if (button.dataset.hint) button.disabled = true, ask(button.dataset.hint);
  });

  let news = 0;
  const source = new EventSource('frames');
  source.onmessage = ({ data }) => {
    const { exercise, busy, text, parts } = JSON.parse(data);
    if (exercise !== document.documentElement.dataset.exercise) return location.reload();
    for (const [id, html] of Object.entries(parts)) show(id, html);
    setState(text, busy ? 'busy' : '');
    ++news;
  };
  const end = () => {
    source.close();
    setState('rex watch has ended; start it again and open its new address', 'lost');
  };
  source.addEventListener('end', end);
  let failures = 0;  // one after the other
  source.onopen = () => { failures = 0; };
  source.onerror = () => {
    if (source.readyState === EventSource.CLOSED || ++failures > 9) return end();
    setState('rex watch does not answer: has it ended?', 'lost');
  };

  window.rexWatch = { news: () => news };  // what tests ask
})();
