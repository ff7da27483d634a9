// A logarithmic axis that keeps what a logarithm drops: zeros, and values that are missing.

var bandPx = 34;
var leastDecades = 0.35;
var axisMargin = 0.06;  // of the scale, free beyond the outermost values

function isMissing(value) {
  return !isFinite(value) || value < 0;
}

function tickLabel(value) {
  return value < 1e-4 || value >= 1e6 ? value.toExponential().replace('+', '') : String(value);
}

// mantissa * 10^power as the nearest number.
function tickValue(mantissa, power) {
  return power < 0 ? mantissa / Math.pow(10, -power) : mantissa * Math.pow(10, power);
}

function mantissasFor(decades) {
  if (decades < 0.6) return [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8];
  if (decades < 1.3) return [1, 1.5, 2, 3, 5, 7];
  return decades < 3.2 ? [1, 2, 5] : [1];
}

function ticksOf(axis, lowLog, highLog) {
  var decades = highLog - lowLog;
  var mantissas = mantissasFor(decades);
  var step = Math.max(1, Math.ceil(decades / 9));
  var ticks = [];
  for (var power = Math.floor(lowLog); power <= Math.floor(highLog); ++power) {
    if (power % step !== 0) continue;
    for (var i = 0; i < mantissas.length; ++i) {
      var value = tickValue(mantissas[i], power);
      var place = Math.log10(value);
      if (place >= lowLog && place <= highLog) ticks.push({px: axis.at(value), label: tickLabel(value)});
    }
  }
  return ticks;
}

// Goes from `fromPx`, the low end, to `toPx`; `toPx` may be the smaller. at(value) is in the band of zeros, of missing
// values, or on the scale: always finite and between the two ends.
function logAxis(values, fromPx, toPx) {
  var positive = values.filter(function (value) { return !isMissing(value) && value > 0; });
  var least = positive.length ? Math.min.apply(null, positive) : 1;
  var most = positive.length ? Math.max.apply(null, positive) : 1;
  var direction = toPx > fromPx ? 1 : -1;
  var start = fromPx;
  var bands = [];
  function band(label) {
    var from = start;
    start += direction * bandPx;
    bands.push({from: from, to: start, label: label});
    return (from + start) / 2;
  }
  var missingPx = values.some(isMissing) ? band('n/a') : fromPx;
  var zeroPx = values.indexOf(0) >= 0 ? band('0') : fromPx;
  var lowLog = Math.log10(least), highLog = Math.log10(most);
  var shortOf = Math.max(0, leastDecades - (highLog - lowLog));
  var free = shortOf / 2 + axisMargin * (highLog - lowLog + shortOf);
  lowLog -= free;
  highLog += free;
  var axis = {
    bands: bands,
    at: function (value) {
      if (value === 0) return zeroPx;
      if (isMissing(value)) return missingPx;
      var share = (Math.log10(value) - lowLog) / (highLog - lowLog);
      return start + Math.min(1, Math.max(0, share)) * (toPx - start);
    }
  };
  axis.ticks = ticksOf(axis, lowLog, highLog);
  return axis;
}
