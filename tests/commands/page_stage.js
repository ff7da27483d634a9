// As much of a browser's document as the page of a trade asks for, so that its script runs without one: elements with
// attributes and children, and what they are as HTML.
'use strict';

function StagedElement(name) {
  this.name = name;
  this.attributes = {};
  this.children = [];
}
StagedElement.prototype.setAttribute = function (name, value) { this.attributes[name] = value; };
StagedElement.prototype.appendChild = function (child) { this.children.push(child); };

function escapedText(text) {
  return String(text).replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;')
    .replace(/'/g, '&#39;');
}

function htmlOf(node) {
  if (node.text !== undefined) return escapedText(node.text);
  var html = '<' + node.name;
  Object.keys(node.attributes).forEach(function (name) {
    html += ' ' + name + '="' + escapedText(node.attributes[name]) + '"';
  });
  html += '>';
  if (node.name === 'img' || node.name === 'br') return html;
  node.children.forEach(function (child) { html += htmlOf(child); });
  return html + '</' + node.name + '>';
}

// The places of the page, in the order in which its script asks for them.
var stagedPlaces = [];

var document = {
  title: '',
  createElement: function (name) { return new StagedElement(name); },
  createElementNS: function (space, name) { return new StagedElement(name); },
  createTextNode: function (text) { return {text: text}; },
  getElementById: function (id) {
    if (id === 'report') return {textContent: stagedReport};
    var found = stagedPlaces.filter(function (place) { return place.attributes.id === id; })[0];
    if (found) return found;
    found = new StagedElement('div');
    found.setAttribute('id', id);
    stagedPlaces.push(found);
    return found;
  }
};

// All that the script has put into the page.
function stagedHtml() {
  return '<title>' + escapedText(document.title) + '</title>' + stagedPlaces.map(htmlOf).join('\n');
}
