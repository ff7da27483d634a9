// The tables, row by row.

function cell(children, style) {
  return element('td', style ? {'class': style} : {}, children);
}

function textCell(text) {
  return cell([text], 'text');
}

function numberCell(raw, style) {
  return isNaN(number(raw)) ? cell(['n/a'], 'none') : cell(figureParts(raw), style);
}

// The worst of an error: with its sign where it is at least that.
function worstCell(raw, atLeast) {
  if (isNaN(number(raw)) || !atLeast) return numberCell(raw);
  return cell(['\u2265 '].concat(figureParts(raw)));
}

function rowHead(text) {
  return element('th', {scope: 'row', 'class': 'text'}, [text]);
}

// Headings {name, columns or rows that one spans, text: what is below it is text}. '\n' in a name begins a line.
function headings(row) {
  return element('tr', {}, row.map(function (head) {
    var attributes = {scope: head.columns ? 'colgroup' : 'col'};
    if (head.columns) attributes.colspan = head.columns;
    if (head.rows) attributes.rowspan = head.rows;
    if (head.text) attributes['class'] = 'text';
    return element('th', attributes, linesOf(head.name));
  }));
}

function linesOf(name) {
  var parts = [];
  name.split('\n').forEach(function (line, i) {
    if (i > 0) parts.push(element('br'));
    parts.push(line);
  });
  return parts;
}

function below(names) {
  return headings(names.map(function (name) { return {name: name}; }));
}

function table(caption, heads, rows) {
  return element('div', {'class': 'table'}, [element('table', {}, [
    element('caption', {}, [caption]), element('thead', {}, heads), element('tbody', {}, rows)
  ])]);
}

// Long tables are closed until someone opens them.
function folded(caption, heads, rows) {
  return element('details', {}, [
    element('summary', {}, [caption + ' (' + counted(rows.length, 'row', 'rows') + ')']), table(caption, heads, rows)
  ]);
}

// `--earth flat --geoid none`, each option unbroken.
function optionParts(options) {
  var parts = [];
  options.split(/ (?=--)/).forEach(function (option, i) {
    if (option === '') return;
    if (i > 0) parts.push(' ');
    parts.push(element('code', {}, [option]));
  });
  return parts;
}

// Time and triangles of the first picture, then of a settled one.
function costCells(of) {
  return [
    numberCell(of.first.gpu_ms), cell([grouped(of.first.triangles)]), numberCell(of.settled.gpu_ms),
    cell([grouped(of.settled.triangles)])
  ];
}

function settingRow(setting) {
  return element('tr', setting.best ? {'class': 'front'} : {}, [
    cell([setting.best ? '\u25cf' : '']), rowHead(setting.name)
  ].concat(costCells(setting), [
    cell(figureParts(megabytes(setting.bytes))), numberCell(setting.ground_m), worstCell(setting.ground_px, setting.at_least.ground_px),
    numberCell(setting.ground_p99_px), worstCell(setting.ground_mean_px, setting.at_least.ground_px),
    worstCell(setting.surface_px, setting.at_least.surface_px), worstCell(setting.seen_px, setting.at_least.seen_px),
    numberCell(setting.skyline_px),
    setting.limit_px === null ? cell(['']) : cell([String(number(setting.limit_px))], setting.over_limit ? 'alarm' : ''),
    cell(optionParts(setting.options), 'text')
  ]));
}

function settingsTable(report) {
  return table('Over all views: median time, sums, worst errors, mean of means. \u25cf is unbeaten: no other setting is both as ' +
               'fast (first picture) and as close, and better in one.', [
    headings([
      {name: '\u25cf', rows: 2}, {name: 'Setting', rows: 2, text: true}, {name: 'First picture', columns: 2},
      {name: 'Settled', columns: 2}, {name: 'Terrain\nMB', rows: 2}, {name: 'Ground', columns: 4},
      {name: 'Surface\nworst px', rows: 2}, {name: 'Seen\nworst px', rows: 2}, {name: 'Skyline\nworst px', rows: 2},
      {name: 'Limit\npx', rows: 2}, {name: 'Options', rows: 2, text: true}
    ]),
    below(['ms', 'triangles', 'ms', 'triangles', 'worst m', 'worst px', '99 % px', 'mean px'])
  ], report.settings.map(settingRow));
}

// Predicted / measured, [least, most] of the views: below 1 a bound does not hold, far above it says little.
function ratioCell(ratio, loose) {
  if (ratio === null) return cell(['n/a'], 'none');
  var least = number(ratio[0]), most = number(ratio[1]);
  var style = least < 1 ? 'alarm' : most > loose ? 'loose' : '';
  var parts = figureParts(least);
  return cell(figure(least) === figure(most) ? parts : parts.concat(['\u2013'], figureParts(most)), style);
}

function effectCells(effect, loose) {
  return [
    numberCell(effect.predicted_m), numberCell(effect.measured_m), ratioCell(effect.ratio_m, loose),
    numberCell(effect.predicted_px), numberCell(effect.measured_px), ratioCell(effect.ratio_px, loose)
  ];
}

function effectHeads(first) {
  return [
    headings(first.concat([
      {name: 'metres', columns: 3}, {name: 'pixels', columns: 3}, {name: 'Remark', rows: 2, text: true}
    ])),
    below(['predicted', 'measured', 'ratio', 'predicted', 'measured', 'ratio'])
  ];
}

function effectsTable(report) {
  return table('Worst of the views. Ratio: predicted / measured, least and most of the views; below 1 a bound does not ' +
               'hold, above ' + report.loose_ratio + ' it says little.',
               effectHeads([{name: 'Setting', rows: 2, text: true}]), report.effects.map(function (effect) {
    var over = effect.over_in > 0 ? element('strong', {}, [
      'More than predicted in ' + (effect.measured_views === 1 ? 'the one view' : effect.over_in + ' of ' +
      counted(effect.measured_views, 'view', 'views')) + '. '
    ]) : null;
    return element('tr', over ? {'class': 'alarm'} : {}, [rowHead(effect.name)].concat(
      effectCells(effect, report.loose_ratio), [cell([over, effect.remark], 'text')]));
  }));
}

function effectsOfViewsTable(report) {
  return folded('Each setting in each view',
                effectHeads([{name: 'View', rows: 2, text: true}, {name: 'Setting', rows: 2, text: true}]),
                report.effects_of_views.map(function (effect) {
    return element('tr', effect.over ? {'class': 'alarm'} : {}, [textCell(effect.view), textCell(effect.name)].concat(
      effectCells(effect, report.loose_ratio), [textCell(effect.remark)]));
  }));
}

function shotRow(report, shot) {
  function cells(error, names) {
    return names.map(function (name) {
      return worstCell(error.count > 0 ? error[name] : null, error.at_least > 0 && (name === 'worst' || name === 'mean'));
    });
  }
  return element('tr', {}, [
    textCell(report.views[shot.view]), textCell(report.settings[shot.setting].name)
  ].concat(costCells(shot), [cell(figureParts(megabytes(shot.bytes)))], cells(shot.ground_m, ['worst', 'p99', 'mean']), cells(shot.ground_px, ['worst', 'p9999', 'p99', 'mean']),
           [cell([grouped(shot.ground_px.count)])], cells(shot.skyline_px, ['worst', 'p99', 'mean']),
           [cell([grouped(shot.skyline_px.count)]), cell([grouped(shot.skyline_in_one_only)])]));
}

function shotsTable(report) {
  return folded('Each view with each setting', [
    headings([
      {name: 'View', rows: 2, text: true}, {name: 'Setting', rows: 2, text: true}, {name: 'First picture', columns: 2},
      {name: 'Settled', columns: 2}, {name: 'Terrain\nMB', rows: 2}, {name: 'Ground, m', columns: 3},
      {name: 'Ground, px', columns: 5}, {name: 'Skyline, px', columns: 5}
    ]),
    below(['ms', 'triangles', 'ms', 'triangles', 'worst', '99 %', 'mean', 'worst', '99.99 %', '99 %', 'mean', 'pixels', 'worst', '99 %', 'mean', 'columns',
           'in one\nalone'])
  ], report.shots.map(function (shot) { return shotRow(report, shot); }));
}
