// The plots, as SVG: points over two logarithmic axes, and points in rows over one.

var plotTextPx = 12;
var rowPx = 28;
var lanePx = 2.6;

// Bar, circle, triangle up, diamond, triangle down, plus, cross, square. The bar is seen behind a circle.
var markShapes = [
  'M-2,-9h4v18h-4z',
  'M-4.5,0a4.5,4.5 0 1,0 9,0a4.5,4.5 0 1,0 -9,0z',
  'M0,-5L5,4H-5z',
  'M0,-5.5L5.5,0L0,5.5L-5.5,0z',
  'M0,5L5,-4H-5z',
  'M-1.5,-5h3v3.5h3.5v3h-3.5v3.5h-3v-3.5h-3.5v-3h3.5z',
  'M-4.5,-3L-3,-4.5L0,-1.5L3,-4.5L4.5,-3L1.5,0L4.5,3L3,4.5L0,1.5L-3,4.5L-4.5,3L-1.5,0z',
  'M-4,-4h8v8h-8z'
];
// With more lanes than this, marks are pale, so that many on one place stand out.
var mostDistinctMarks = markShapes.length - 2;

// Hundredths are enough on a screen.
function px(value) {
  return Math.round(value * 100) / 100;
}

function moved(x, y) {
  return 'translate(' + px(x) + ',' + px(y) + ')';
}

function svgLine(style, x1, y1, x2, y2) {
  return svgElement('line', {'class': style, x1: px(x1), y1: px(y1), x2: px(x2), y2: px(y2)});
}

function svgRectangle(style, box) {
  return svgElement('rect', {
    'class': style, x: px(box.left), y: px(box.top), width: px(box.right - box.left), height: px(box.bottom - box.top)
  });
}

function svgText(style, anchor, x, y, text) {
  return svgElement('text', {'class': style, 'text-anchor': anchor, x: px(x), y: px(y)}, [text]);
}

// Bands, gridlines, ticks and title below `frame`.
function horizontalAxis(axis, frame, title) {
  var parts = [];
  axis.bands.forEach(function (band) {
    parts.push(svgRectangle('band', {left: band.from, top: frame.top, right: band.to, bottom: frame.bottom}));
    parts.push(svgText('tick', 'middle', (band.from + band.to) / 2, frame.bottom + 18, band.label));
  });
  axis.ticks.forEach(function (tick) {
    parts.push(svgLine('grid', tick.px, frame.top, tick.px, frame.bottom));
    parts.push(svgText('tick', 'middle', tick.px, frame.bottom + 18, tick.label));
  });
  parts.push(svgText('title', 'middle', (frame.left + frame.right) / 2, frame.bottom + 38, title));
  return parts;
}

function verticalAxis(axis, frame, title) {
  var parts = [];
  axis.bands.forEach(function (band) {
    parts.push(svgRectangle('band', {left: frame.left, top: band.to, right: frame.right, bottom: band.from}));
    parts.push(svgText('tick', 'end', frame.left - 8, (band.from + band.to) / 2 + 4, band.label));
  });
  axis.ticks.forEach(function (tick) {
    parts.push(svgLine('grid', frame.left, tick.px, frame.right, tick.px));
    parts.push(svgText('tick', 'end', frame.left - 8, tick.px + 4, tick.label));
  });
  parts.push(svgElement('text', {
    'class': 'title', 'text-anchor': 'middle',
    transform: moved(14, (frame.top + frame.bottom) / 2) + ' rotate(-90)'
  }, [title]));
  return parts;
}

// The points a plot states are those it was given: whoever counts its marks knows whether one was lost.
function plotElement(head, points, parts) {
  return element('div', {'class': 'plot'}, [svgElement('svg', {
    role: 'img', 'aria-label': head.label, 'data-plot': head.id, 'data-points': points,
    viewBox: '0 0 ' + head.width + ' ' + head.height, width: head.width, height: head.height
  }, parts)]);
}

function scatterPoint(point, place) {
  return svgElement('g', {
    'class': 'point ' + (point.best ? 'front' : 'other'), 'data-setting': point.name,
    transform: moved(place.x, place.y)
  }, [svgElement('title', {}, [point.tip]), svgElement('circle', {r: point.best ? 5.5 : 4.5})]);
}

function scatterLabel(point, place, label) {
  var middle = (label.box.left + label.box.right) / 2;
  var x = label.anchor === 'start' ? label.box.left : label.anchor === 'end' ? label.box.right : middle;
  return [
    label.leader ? svgLine('leader', place.x, place.y, label.end.x, label.end.y) : null,
    svgText(point.best ? 'name front' : 'name', label.anchor, x, label.box.bottom - 3.5, point.name)
  ];
}

// Points {name, tip, x, y, best} over two logarithmic axes. Every point is marked, and named where there is room. The
// best are named first, and drawn last; `joinBest` draws a line through them.
function scatterPlot(head, xTitle, yTitle, points, joinBest) {
  var frame = {left: 62, top: 8, right: head.width - 12, bottom: head.height - 46};
  var sorted = points.filter(function (point) { return point.best; })
    .concat(points.filter(function (point) { return !point.best; }));
  var xAxis = logAxis(sorted.map(function (point) { return point.x; }), frame.left, frame.right);
  var yAxis = logAxis(sorted.map(function (point) { return point.y; }), frame.bottom, frame.top);
  var places = sorted.map(function (point) { return {x: xAxis.at(point.x), y: yAxis.at(point.y)}; });
  var best = places.filter(function (place, i) { return joinBest && sorted[i].best; });
  best.sort(function (a, b) { return a.x - b.x; });
  var labels = placeLabels(places, sorted.map(function (point) { return textWidthPx(point.name, plotTextPx); }),
                           frame, best);
  var parts = horizontalAxis(xAxis, frame, xTitle).concat(verticalAxis(yAxis, frame, yTitle));
  parts.push(svgRectangle('frame', frame));
  if (best.length > 1) {
    var corners = best.map(function (place) { return px(place.x) + ',' + px(place.y); });
    parts.push(svgElement('polyline', {'class': 'front', points: corners.join(' ')}));
  }
  labels.forEach(function (label, i) {
    if (label) parts = parts.concat(scatterLabel(sorted[i], places[i], label));
  });
  for (var i = sorted.length; i-- > 0;) parts.push(scatterPoint(sorted[i], places[i]));
  var nameless = labels.filter(function (label) { return !label; }).length;
  return [
    plotElement(head, points.length, parts),
    nameless ? element('p', {'class': 'note'}, [
      nameless + ' points have no room for their names; they say them when pointed at.'
    ]) : null
  ];
}

function rowPoint(point, x, y, many) {
  var attributes = {
    'class': 'point mark' + point.mark + (isMissing(point.value) ? ' missing' : '') + (many ? ' many' : ''),
    transform: moved(x, y)
  };
  Object.keys(point.data).forEach(function (name) { attributes['data-' + name] = point.data[name]; });
  return svgElement('g', attributes,
                    [svgElement('title', {}, [point.tip]), svgElement('path', {d: markShapes[point.mark]})]);
}

function rowParts(row, axis, frame, y, lanes) {
  var parts = [
    svgLine('grid', frame.left, y, frame.right, y),
    svgText(row.alarm ? 'row alarm' : 'row', 'end', frame.left - 10, y + 4, row.name)
  ];
  if (row.joined && row.points.length > 1)
    parts.push(svgLine(row.alarm ? 'join alarm' : 'join', axis.at(row.points[0].value), y,
                       axis.at(row.points[row.points.length - 1].value), y));
  row.points.forEach(function (point) {
    var down = (point.lane - (lanes - 1) / 2) * Math.min(lanePx, (rowPx - 10) / lanes);
    parts.push(rowPoint(point, axis.at(point.value), y + down, lanes > mostDistinctMarks));
  });
  if (row.limit !== null)
    parts.push(svgElement('g', {'class': 'limit'}, [
      svgElement('title', {}, [row.limitTip]),
      svgElement('path', {d: 'M' + px(axis.at(row.limit)) + ',' + px(y - rowPx / 2 + 2) + 'v' + (rowPx - 4)})
    ]));
  return parts;
}

// Rows {name, points, limit, limitTip, joined, alarm} of points {data, tip, value, mark, lane} over one axis. The points
// of a row lie in `lanes`, a little below each other. `limit`: a line across the row, or null.
function rowPlot(head, xTitle, rows, lanes) {
  var namesPx = 40, values = [], count = 0;
  rows.forEach(function (row) {
    namesPx = Math.max(namesPx, textWidthPx(row.name, plotTextPx));
    row.points.forEach(function (point) { values.push(point.value); });
    if (row.limit !== null) values.push(row.limit);
    count += row.points.length;
  });
  var rowsPx = rowPx * Math.max(rows.length, 1);
  var frame = {left: Math.min(namesPx + 14, head.width / 2), top: 8, right: head.width - 12, bottom: 8 + rowsPx};
  var axis = logAxis(values, frame.left, frame.right);
  var parts = horizontalAxis(axis, frame, xTitle);
  parts.push(svgRectangle('frame', frame));
  rows.forEach(function (row, i) {
    parts = parts.concat(rowParts(row, axis, frame, frame.top + rowPx * (i + 0.5), lanes));
  });
  head.height = rowsPx + 8 + 46;
  return [plotElement(head, count, parts)];
}

// A mark by itself, and what it stands for.
function markKey(mark, text) {
  return element('span', {}, [
    svgElement('svg', {'class': 'key', 'aria-hidden': 'true', width: 14, height: 14, viewBox: '-9 -9 18 18'}, [
      svgElement('g', {'class': 'mark' + mark}, [svgElement('path', {d: markShapes[mark]})])
    ]), ' ' + text
  ]);
}
