// Tables, copy buttons and navigation of a report. The page is complete without this script.
(function () {
  'use strict';

  const all = (selector, root) => [...(root || document).querySelectorAll(selector)];

  // Tables: a click on a heading sorts up, then down, then restores the order of the document.

  function valueOf(cell) {
    const text = cell.textContent.trim();
    if (cell.dataset.value !== undefined) return parseFloat(cell.dataset.value);
    return cell.classList.contains('number') ? parseFloat(text.replace('−', '-')) : text;
  }

  // Cells without a value come last in both directions.
  function compare(a, b, sign) {
    const isMissing = (value) => value === '' || Number.isNaN(value);
    if (isMissing(a) || isMissing(b)) return isMissing(a) - isMissing(b);
    if (typeof a === 'number' && typeof b === 'number') return sign * (a - b);
    return sign * String(a).localeCompare(String(b), undefined, {numeric: true});
  }

  function makeSortable(table) {
    const body = table.tBodies[0];
    const heads = all('thead tr:last-child th', table);
    if (!body) return;
    const original = [...body.rows];
    heads.forEach((head, column) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.title = 'Sort by this column';
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener('click', () => {
        const next = {ascending: 'descending', descending: ''}[head.getAttribute('aria-sort')];
        const order = next === undefined ? 'ascending' : next;
        heads.forEach((each) => each.removeAttribute('aria-sort'));
        const rows = original.map((row) => ({row, value: valueOf(row.cells[column])}));
        if (order) {
          head.setAttribute('aria-sort', order);
          const sign = order === 'ascending' ? 1 : -1;
          rows.sort((a, b) => compare(a.value, b.value, sign));
        }
        body.append(...rows.map(({row}) => row));
      });
    });
  }

  // Copy buttons.

  const status = document.createElement('div');
  status.className = 'live-status';
  status.setAttribute('role', 'status');
  document.body.append(status);

  // The writer puts a backslash after each "<", so that no text can end or open a script.
  function storedText(id) {
    return document.getElementById(id).textContent.replace(/<\\/g, '<');
  }

  async function copy(text, button) {
    try {
      await navigator.clipboard.writeText(text);
      return true;
    } catch (error) {
      // No permission or no secure context: the old way, and then by hand.
    }
    const area = document.createElement('textarea');
    area.className = 'by-hand';
    area.readOnly = true;
    area.value = text;
    area.setAttribute('aria-label', 'Text to copy');
    all('textarea.by-hand').forEach((old) => old.remove());
    button.parentNode.append(area);
    area.select();
    const isCopied = document.execCommand('copy');
    if (isCopied) {
      area.remove();
      button.focus();
    }
    return isCopied;
  }

  function makeCopying(button) {
    button.type = 'button';
    button.addEventListener('click', async () => {
      const isCopied = await copy(storedText(button.dataset.copy), button);
      status.textContent = isCopied ? `${button.textContent}: copied`
        : 'Press Ctrl+C to copy the selected text';
      button.classList.toggle('copied', isCopied);
      setTimeout(() => button.classList.remove('copied'), 1600);
    });
  }

  // Charts scroll within their figure before their text becomes too small to read.

  function makeReadable(svg) {
    const width = svg.viewBox.baseVal ? svg.viewBox.baseVal.width : 0;
    if (!svg.parentNode.matches('.scroll')) {
      const scroll = document.createElement('div');
      scroll.className = 'scroll';
      svg.replaceWith(scroll);
      scroll.append(svg);
    }
    if (width > 0) svg.style.minWidth = 0.75 * width + 'px';
  }

  // What scrolls sideways must be reachable by keyboard.
  function updateScrollers() {
    for (const scroll of all('.scroll')) {
      const figure = scroll.closest('figure');
      const caption = figure && figure.querySelector('figcaption');
      if (scroll.scrollWidth > scroll.clientWidth + 1) {
        scroll.tabIndex = 0;
        scroll.setAttribute('role', 'region');
        scroll.setAttribute('aria-label', caption ? caption.textContent : 'Scrollable');
      } else {
        scroll.removeAttribute('tabindex');
        scroll.removeAttribute('role');
        scroll.removeAttribute('aria-label');
      }
    }
  }

  // Navigation: marks the section that is being read.

  function followSections() {
    const nav = document.querySelector('nav');
    const links = all('nav a[href^="#"]');
    const targets = links.map((link) => document.getElementById(link.hash.slice(1)));
    let isScheduled = false;
    const update = () => {
      isScheduled = false;
      const isAtEnd = window.innerHeight + window.scrollY >= document.body.scrollHeight - 2;
      let current = -1;
      targets.forEach((target, i) => {
        if (target && target.getBoundingClientRect().top < 0.3 * window.innerHeight) current = i;
      });
      if (isAtEnd && window.scrollY > 0) current = targets.length - 1;
      // On small screens the navigation is a bar that scrolls.
      if (links[current] && nav.scrollWidth > nav.clientWidth) {
        nav.scrollLeft = links[current].offsetLeft - nav.clientWidth / 3;
      }
      links.forEach((link, i) => {
        if (i === current) link.setAttribute('aria-current', 'true');
        else link.removeAttribute('aria-current');
      });
    };
    const schedule = () => {
      if (!isScheduled) requestAnimationFrame(update);
      isScheduled = true;
    };
    window.addEventListener('scroll', schedule, {passive: true});
    window.addEventListener('resize', schedule);
    schedule();
  }

  all('table.sortable').forEach(makeSortable);
  all('button[data-copy]').forEach(makeCopying);
  all('figure.chart svg').forEach(makeReadable);
  updateScrollers();
  window.addEventListener('resize', updateScrollers);
  followSections();
})();
