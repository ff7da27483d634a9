// Fills the page from its data.

var fullWidth = 1040;
var halfWidth = 512;

function put(id, children) {
  filled(document.getElementById(id), {}, children);
}

function fact(name, parts, wide) {
  return parts.length === 0 || parts[0] === '' ? [] :
    [element('dt', {}, [name]), element('dd', wide ? {'class': 'wide'} : {}, parts)];
}

function factsOf(report) {
  var size = report.size_px[0] + ' \u00d7 ' + report.size_px[1] + ' px';
  var views = report.views.length === 0 ? 'none' : counted(report.views.length, 'view', 'views') + ' of ' + size;
  return element('dl', {}, [].concat(
    fact('Region', [report.region], true), fact('Views', [views]), fact('Settings', [report.settings.length]),
    fact('GPU', [report.gpu]), fact('Driver', [report.driver]), fact('Machine', [report.machine]),
    fact('Pipeline', [report.pipeline]), fact('Program', [report.version]), fact('Made', [report.time]),
    report.command === '' ? [] : fact('Command', [element('code', {}, [report.command])], true)));
}

function bestFinding(report) {
  var best = report.settings.filter(function (setting) { return setting.best; });
  if (best.length === 0) return null;
  best.sort(function (a, b) { return a.first.gpu_ms - b.first.gpu_ms; });
  function said(setting) {
    return [element('strong', {}, [setting.name]),
            ' (' + figure(setting.first.gpu_ms) + ' ms, ' + figure(setting.ground_px) + ' px)'];
  }
  var begin = ['Unbeaten ' + (best.length === 1 ? 'is ' : 'are ') + best.length + ' of ' +
               counted(report.settings.length, 'setting', 'settings') + ': '];
  if (best.length === 1) return element('li', {}, begin.concat(said(best[0]), [' alone.']));
  return element('li', {}, begin.concat(['from the fastest, '], said(best[0]), [', to the closest, '],
                                        said(best[best.length - 1]), ['.']));
}

function limitFinding(limits) {
  if (limits.pictures === 0) return null;
  if (limits.over === 0)
    return element('li', {}, ['All ' + counted(limits.pictures, 'picture', 'pictures') +
                              ' of settings that have a limit keep it.']);
  return element('li', {'class': 'alarm'}, [
    'Of the ' + counted(limits.pictures, 'picture', 'pictures') + ' of settings that have a limit, ' + limits.over +
    (limits.over === 1 ? ' is' : ' are') + ' over it.'
  ]);
}

function boundsFinding(bounds, loose) {
  if (bounds.measured === 0) return null;
  var all = counted(bounds.measured, 'prediction', 'predictions');
  var held = bounds.over === 0 ? 'All ' + all + ' that could be measured hold; ' :
    'In ' + bounds.over + ' of ' + all + ' that could be measured there was more than predicted; ';
  return element('li', bounds.over === 0 ? {} : {'class': 'alarm'}, [
    held + bounds.loose + (bounds.loose === 1 ? ' is' : ' are') + ' more than ' + loose +
    ' times what was measured; ' + bounds.unmeasured + ' could not be measured.'
  ]);
}

function findingsOf(report) {
  var items = [bestFinding(report), limitFinding(report.limits), boundsFinding(report.bounds, report.loose_ratio)];
  if (items.every(function (item) { return item === null; }))
    return element('p', {'class': 'note'}, ['Nothing was measured.']);
  return element('ul', {'class': 'findings'}, items);
}

function settingTip(setting) {
  function cost(of) { return figure(of.gpu_ms) + ' ms, ' + grouped(of.triangles) + ' triangles'; }
  return setting.name + (setting.options === '' ? '' : ' (' + setting.options + ')') + '\nfirst picture: ' +
    cost(setting.first) + ', ' + figure(megabytes(setting.bytes)) + ' MB\nsettled: ' + cost(setting.settled) + '\n' +
    (isNaN(number(setting.ground_px)) ? 'ground not measured' : 'worst error of ground ' + figure(setting.ground_px) + ' px') +
    (setting.best ? '\nunbeaten' : '');
}

function settingsPlot(report, head, xTitle, cost) {
  put('plot-' + head.id, scatterPlot(head, xTitle, 'Worst error of ground (px)', report.settings.map(function (setting) {
    return {
      name: setting.name, tip: settingTip(setting), x: cost(setting), y: number(setting.ground_px), best: setting.best
    };
  }), head.id === 'time'));
}

function settingsPlots(report) {
  settingsPlot(report, {id: 'time', label: 'GPU time against worst error of ground, one point a setting', width: fullWidth, height: 480},
               'GPU time of the first picture (ms, median of the views)',
               function (setting) { return number(setting.first.gpu_ms); });
  settingsPlot(report, {id: 'triangles', label: 'Triangles against worst error of ground, one point a setting', width: halfWidth, height: 430},
               'Triangles of the first picture (millions, all views)',
               function (setting) { return setting.first.triangles / 1e6; });
  settingsPlot(report, {id: 'bytes', label: 'Terrain read against worst error of ground, one point a setting', width: halfWidth, height: 430},
               'Terrain read (MB, all views)', function (setting) { return megabytes(setting.bytes); });
}

function effectTip(effect, what, px, m) {
  return effect.name + '\n' + what + ': ' + figure(px) + ' px, ' + figure(m) + ' m';
}

function effectRow(effect) {
  var measured = !isNaN(number(effect.measured_px));
  // A bound that is no number is one, and broken.
  var predicted = effect.predicted_px !== null || effect.over_in > 0;
  var data = {effect: effect.name};
  return {
    name: effect.name, joined: measured && predicted, alarm: effect.over_in > 0, limit: null,
    points: [
      {data: data, tip: predicted ? effectTip(effect, 'predicted bound', effect.predicted_px, effect.predicted_m) :
         effect.name + '\nnot predicted',
       value: number(effect.predicted_px), mark: 0, lane: 0},
      {data: data,
       tip: measured ? effectTip(effect, 'measured worst', effect.measured_px, effect.measured_m) :
         effect.name + '\nnot measured' + (effect.remark === '' ? '' : ': ' + effect.remark),
       value: number(effect.measured_px), mark: 1, lane: 0}
    ]
  };
}

function effectsPlot(report) {
  put('keys-effects', [markKey(0, 'predicted bound'), markKey(1, 'measured worst')]);
  put('plot-effects', rowPlot({id: 'effects', label: 'Predicted bound and measured worst of each setting, in pixels', width: fullWidth},
                              'Error (px, worst of the views)', report.effects.map(effectRow), 1));
}

// Colours and shapes tell views apart as long as there are enough.
function toldApart(report) {
  return report.views.length <= mostDistinctMarks;
}

function viewsKeys(report) {
  if (!toldApart(report)) return [markKey(1, 'a view (point at it for its name); many on one place stand out')];
  return report.views.map(function (view, i) { return markKey(i + 2, view); });
}

// One row a setting, one mark a view. `withLimits`: the error is the one that settings have a limit for.
function viewsPlot(report, head, xTitle, error, withLimits) {
  var rows = report.settings.map(function (setting) {
    var limit = withLimits ? setting.limit_px : null;
    return {name: setting.name, points: [], joined: false, alarm: false, limit: limit,
            limitTip: 'limit of ' + setting.name + ': ' + number(limit) + ' px'};
  });
  report.shots.forEach(function (shot) {
    var row = rows[shot.setting], summary = shot[error], view = report.views[shot.view];
    var worst = summary.count > 0 ? number(summary.worst) : NaN;
    row.points.push({
      data: {view: view, setting: row.name}, value: worst, lane: shot.view, mark: toldApart(report) ? shot.view + 2 : 1,
      tip: view + '\n' + row.name + ': worst ' + figure(worst) + ' px, 99 % within ' +
        figure(summary.count > 0 ? summary.p99 : null) + ' px'
    });
    if (row.limit !== null && summary.count > 0 && !(worst <= row.limit)) row.alarm = true;
  });
  put('keys-' + head.id, viewsKeys(report));
  put('plot-' + head.id, rowPlot(head, xTitle, rows, Math.max(report.views.length, 1)));
}

function viewsPlots(report) {
  viewsPlot(report, {id: 'views', label: 'Worst error of ground of each view, by setting', width: fullWidth},
            'Worst error of ground (px)', 'ground_px', true);
  viewsPlot(report, {id: 'skylines', label: 'Worst error of the skyline of each view, by setting', width: fullWidth},
            'Worst error of the skyline (px)', 'skyline_px', false);
}

function pictureOf(picture) {
  return element('figure', {}, [
    picture.png === '' ? element('p', {'class': 'note'}, ['no picture']) : element('img', {
      alt: picture.title, width: picture.size_px[0], height: picture.size_px[1],
      src: 'data:image/png;base64,' + picture.png
    }),
    element('figcaption', {}, [element('strong', {}, [picture.title]), picture.caption])
  ]);
}

function fillPage() {
  var report = JSON.parse(document.getElementById('report').textContent);
  if (report.region !== '') document.title = 'Orograph: what accuracy costs over ' + report.region;
  put('facts', [factsOf(report)]);
  put('findings', [findingsOf(report)]);
  settingsPlots(report);
  put('table-settings', [settingsTable(report)]);
  effectsPlot(report);
  put('table-effects', [effectsTable(report), effectsOfViewsTable(report)]);
  viewsPlots(report);
  put('table-shots', [shotsTable(report)]);
  if (report.pictures.length > 0)
    put('pictures', [element('h2', {}, ['Pictures']),
                     element('div', {'class': 'pictures'}, report.pictures.map(pictureOf))]);
}

fillPage();
