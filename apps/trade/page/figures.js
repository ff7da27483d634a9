// Numbers as people read them, and elements that hold text: nothing that comes from the data is ever read as HTML.
'use strict';

var svgSpace = 'http://www.w3.org/2000/svg';

// element('td', {'class': 'text'}, ['text', otherElement])
function element(name, attributes, children) {
  return filled(document.createElement(name), attributes, children);
}

function svgElement(name, attributes, children) {
  return filled(document.createElementNS(svgSpace, name), attributes, children);
}

function filled(made, attributes, children) {
  Object.keys(attributes || {}).forEach(function (name) {
    made.setAttribute(name, String(attributes[name]));
  });
  (children || []).forEach(function (child) {
    if (child === null) return;
    made.appendChild(typeof child === 'object' ? child : document.createTextNode(String(child)));
  });
  return made;
}

// JSON has no infinity: it comes as text. What is no number comes as null.
function number(value) {
  if (value === null || value === undefined) return NaN;
  if (value === 'inf') return Infinity;
  return value === '-inf' ? -Infinity : value;
}

// '0', '0.012', '1.3', '12.4', '316', '4.2e-5'; 'n/a' for what is no number.
function figure(raw) {
  var value = number(raw);
  if (isNaN(value)) return 'n/a';
  if (!isFinite(value)) return value > 0 ? 'inf' : '-inf';
  if (value === 0) return '0';
  var size = Math.abs(value);
  if (size < 1e-3 || size >= 1e6) return value.toExponential(1).replace('+', '');
  if (size >= 100) return value.toFixed(0);
  if (size >= 10) return value.toFixed(1);
  return value.toFixed(1 - Math.floor(Math.log10(size)));
}

// '4.2e-5' as 4.2 · 10 to the -5th: the children of an element.
function figureParts(raw) {
  var parts = figure(raw).split('e');
  if (parts.length < 2) return parts;
  return [parts[0] + '\u00b710', element('sup', {}, [parts[1].replace('-', '\u2212')])];
}

// '12,345,678'
function grouped(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, ',');
}

function megabytes(bytes) {
  return bytes / 1e6;
}

function counted(count, one, many) {
  return count + ' ' + (count === 1 ? one : many);
}
