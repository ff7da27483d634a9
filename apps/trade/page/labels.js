// Where the names of points go on a plot, so that they lie neither on each other nor on points.

var labelHeightPx = 15;
var pointRadiusPx = 6;
var leaderFromPx = 14;  // distance from which on a line joins label and point
var labelDistancesPx = [9, 16, 24, 34, 46, 60, 76, 94, 114, 138, 166, 200];
var labelDirections = 32;

// About how wide text of this size is drawn, px; rather too much than too little.
function textWidthPx(text, sizePx) {
  return 0.58 * sizePx * text.length + 4;
}

function overlap(a, b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

function inside(box, room) {
  return box.left >= room.left && box.right <= room.right && box.top >= room.top && box.bottom <= room.bottom;
}

function around(place, halfPx) {
  return {left: place.x - halfPx, top: place.y - halfPx, right: place.x + halfPx, bottom: place.y + halfPx};
}

// Whether a stretch touches a box. Source: Liang and Barsky, 1984.
function crosses(box, from, to) {
  var enter = 0, leave = 1;
  function clip(step, room) {
    if (step === 0) return room >= 0;
    if (step < 0)
      enter = Math.max(enter, room / step);
    else
      leave = Math.min(leave, room / step);
    return enter <= leave;
  }
  return clip(from.x - to.x, from.x - box.left) && clip(to.x - from.x, box.right - from.x) &&
    clip(from.y - to.y, from.y - box.top) && clip(to.y - from.y, box.bottom - from.y);
}

function stretchesCross(a, b, c, d) {
  function side(p, q, r) {
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

// The label whose nearest point lies `distancePx` from the point, in the direction of `angle`.
function labelAt(point, widthPx, angle, distancePx) {
  var right = Math.cos(angle), down = Math.sin(angle);
  var end = {x: point.x + right * distancePx, y: point.y + down * distancePx};
  var anchor = right > 0.3 ? 'start' : right < -0.3 ? 'end' : 'middle';
  var left = anchor === 'start' ? end.x : anchor === 'end' ? end.x - widthPx : end.x - widthPx / 2;
  var top = end.y - labelHeightPx * (0.5 - 0.5 * down);
  return {
    box: {left: left, top: top, right: left + widthPx, bottom: top + labelHeightPx},
    anchor: anchor,
    leader: distancePx >= leaderFromPx,
    end: end
  };
}

// Whether a label may go there. `clear`: leaders cross neither each other nor labels.
function labelFits(label, index, points, placed, room, clear) {
  if (!inside(label.box, room)) return false;
  if (points.some(function (point) { return overlap(label.box, around(point, pointRadiusPx)); })) return false;
  return placed.every(function (other) {
    if (overlap(label.box, other.label.box)) return false;
    if (!clear) return true;
    if (other.label.leader && crosses(label.box, other.point, other.label.end)) return false;
    if (!label.leader) return true;
    if (crosses(other.label.box, points[index], label.end)) return false;
    return !(other.label.leader && stretchesCross(points[index], label.end, other.point, other.label.end));
  });
}

// Lines through the label, and points that its leader runs over.
function labelCost(label, index, points, line) {
  var cost = 0;
  for (var i = 0; i + 1 < line.length; ++i)
    if (crosses(label.box, line[i], line[i + 1])) cost += 40;
  if (!label.leader) return cost;
  points.forEach(function (point, other) {
    if (other !== index && crosses(around(point, pointRadiusPx), points[index], label.end)) cost += 25;
  });
  return cost;
}

function bestLabel(index, widthPx, points, placed, room, line, clear) {
  var best = null, bestCost = 1e9;
  labelDistancesPx.forEach(function (distancePx) {
    for (var i = 0; i < labelDirections; ++i) {
      var label = labelAt(points[index], widthPx, 2 * Math.PI * i / labelDirections, distancePx);
      if (!labelFits(label, index, points, placed, room, clear)) continue;
      var cost = distancePx + labelCost(label, index, points, line) + (i === 0 ? 0 : 2);
      if (cost >= bestCost) continue;
      bestCost = cost;
      best = label;
    }
  });
  return best;
}

// One for each point, in their order; null where there is no room. Later points give way to earlier ones. `line` is a
// polyline that labels should not cross but may.
function placeLabels(points, widthsPx, room, line) {
  var placed = [];
  return points.map(function (point, index) {
    var label = bestLabel(index, widthsPx[index], points, placed, room, line, true) ||
      bestLabel(index, widthsPx[index], points, placed, room, line, false);
    if (label) placed.push({point: point, label: label});
    return label;
  });
}
