// Shows what `orograph export` wrote beside this page: globe/ (3D Tiles), terrain/ (quantized-mesh), map/
// (terrain-rgb). Nothing comes from anywhere else. The address says what is shown, and from where:
//
//     ?show=globe|terrain|map&eye=LAT,LON,H,HEADING,PITCH,FOV&error=PIXELS
//
// H is metres above the ellipsoid, FOV the angle of view from the bottom of the picture to its top, all angles are
// degrees. Without an eye all of the region is shown. For 3D Tiles also: tiles=FOLDER, another than globe; light=plain,
// for those without normals; time=2026-06-21T08:00:00Z, when the sun stands as it does in the picture (now). window.region has what was made, and when it is there.

const kinds = {
  globe: { file: "globe/tileset.json", label: "3D Tiles", make: showGlobe },
  terrain: { file: "terrain/layer.json", label: "Globe", make: showTerrain },
  map: { file: "map/tiles.json", label: "Map", make: showMap },
};
const cesium = "node_modules/cesium/Build/Cesium/", maplibre = "node_modules/maplibre-gl/dist/";
const asked = new URLSearchParams(location.search);
const said = document.getElementById("said");

function say(text) {
  said.textContent = text;
  said.hidden = text === "";
}

async function jsonOf(file) {
  const answer = await fetch(file);
  return answer.ok ? answer.json() : undefined;
}

// A script or a style sheet of a library.
function load(file) {
  return new Promise((done, failed) => {
    const isStyle = file.endsWith(".css");
    const element = document.createElement(isStyle ? "link" : "script");
    if (isStyle) element.rel = "stylesheet";
    element[isStyle ? "href" : "src"] = file;
    element.onload = done;
    element.onerror = () => failed(new Error(`${file} is not here: npm install brings it`));
    document.head.append(element);
  });
}

const eyeAsked = asked.has("eye") ? asked.get("eye").split(",").map(Number) : undefined;
const pixels = Number(asked.get("error") ?? 4);

async function loadCesium() {
  window.CESIUM_BASE_URL = cesium;
  await Promise.all([load(cesium + "Cesium.js"), load(cesium + "Widgets/widgets.css")]);
  Cesium.Ion.defaultAccessToken = "";
}

function viewer(options) {
  const made = new Cesium.Viewer("view", {
    baseLayer: false, baseLayerPicker: false, geocoder: false, animation: false, timeline: false, homeButton: false,
    sceneModePicker: false, navigationHelpButton: false, infoBox: false, selectionIndicator: false,
    contextOptions: { webgl: { preserveDrawingBuffer: true } }, ...options,
  });
  // The sun stands as it does now, and below the horizon at night.
  if (asked.has("time")) made.clock.currentTime = Cesium.JulianDate.fromIso8601(asked.get("time"));
  if (eyeAsked) {
    const [lat, lon, h, heading, pitch, fov] = eyeAsked;
    const { camera } = made;
    const wide = made.canvas.clientWidth / made.canvas.clientHeight;
    // Cesium's angle is that of the longer side.
    const half = Math.tan(Cesium.Math.toRadians(fov) / 2);
    camera.frustum.fov = wide > 1 ? 2 * Math.atan(half * wide) : Cesium.Math.toRadians(fov);
    camera.setView({
      destination: Cesium.Cartesian3.fromDegrees(lon, lat, h),
      orientation: { heading: Cesium.Math.toRadians(heading), pitch: Cesium.Math.toRadians(pitch), roll: 0 },
    });
  }
  return made;
}

// Light for tiles without normals: of the plane of each triangle.
function plainLight() {
  return new Cesium.CustomShader({
    lightingModel: Cesium.LightingModel.UNLIT,
    fragmentShaderText: `void fragmentMain(FragmentInput fsInput, inout czm_modelMaterial material) {
      vec3 normal = normalize(cross(dFdx(fsInput.attributes.positionEC), dFdy(fsInput.attributes.positionEC)));
      material.diffuse *= 0.3 + 0.7 * max(0.0, dot(normal, czm_sunDirectionEC));
    }`,
  });
}

async function showGlobe() {
  await loadCesium();
  const made = viewer({ globe: false, skyAtmosphere: false });
  const folder = asked.get("tiles")?.match(/^[a-z0-9]+$/)?.[0] ?? "globe";
  const tileset = await Cesium.Cesium3DTileset.fromUrl(`${folder}/tileset.json`, { maximumScreenSpaceError: pixels });
  if (asked.get("light") === "plain") tileset.customShader = plainLight();
  made.scene.primitives.add(tileset);
  if (!eyeAsked) await made.zoomTo(tileset);
  await new Promise((done) => {
    tileset.allTilesLoaded.addEventListener(done);
  });
  return { viewer: made, tileset };
}

async function showTerrain(layer) {
  await loadCesium();
  const made = viewer({ terrainProvider: await Cesium.CesiumTerrainProvider.fromUrl("terrain") });
  made.scene.globe.maximumScreenSpaceError = pixels;
  made.scene.globe.enableLighting = true;
  made.scene.globe.baseColor = Cesium.Color.fromCssColorString("#b9b29f");
  const [west, south, east, north] = layer.bounds ?? [-180, -90, 180, 90];
  if (!eyeAsked) made.camera.setView({ destination: Cesium.Rectangle.fromDegrees(west, south, east, north) });
  await new Promise((done) => {
    const wait = () => (made.scene.globe.tilesLoaded ? done() : setTimeout(wait, 200));
    setTimeout(wait, 1000);
  });
  return { viewer: made };
}

async function showMap(tiles) {
  await load(maplibre + "maplibre-gl.css");
  const maplibregl = await import(`./${maplibre}maplibre-gl.mjs`);
  const heights = {
    type: "raster-dem", encoding: "mapbox", tileSize: 256,
    tiles: [new URL("map/{z}/{x}/{y}.png", location.href).href.replaceAll("%7B", "{").replaceAll("%7D", "}")],
    minzoom: tiles.minzoom, maxzoom: tiles.maxzoom, bounds: tiles.bounds, attribution: tiles.attribution,
  };
  const [west, south, east, north] = tiles.bounds;
  const [lat, lon] = eyeAsked ?? [0.5 * (south + north), 0.5 * (west + east)];
  const map = new maplibregl.Map({
    container: "view", center: [lon, lat], zoom: Math.min(tiles.maxzoom, tiles.minzoom + 4), pitch: 60,
    canvasContextAttributes: { preserveDrawingBuffer: true },
    style: {
      version: 8, sources: { shade: heights, ground: heights },
      layers: [{ id: "shade", type: "hillshade", source: "shade" }],
      terrain: { source: "ground" },
    },
  });
  await map.once("idle");
  return { map };
}

async function begin() {
  const there = {};
  for (const [kind, { file }] of Object.entries(kinds)) there[kind] = await jsonOf(file);
  const kind = asked.get("show") ?? Object.keys(kinds).find((name) => there[name]);
  if (!kind || !there[kind]) throw new Error("there is nothing beside this page: see README.md");
  const nav = document.querySelector("nav");
  for (const [name, { label }] of Object.entries(kinds)) {
    if (!there[name]) continue;
    const link = document.createElement("a");
    link.href = `?show=${name}`;
    link.textContent = label;
    if (name === kind) link.setAttribute("aria-current", "page");
    nav.append(link);
  }
  nav.hidden = asked.has("eye") || nav.childElementCount < 2;
  say(`Loading ${kinds[kind].label} ...`);
  const made = await kinds[kind].make(there[kind]);
  say("");
  return made;
}

window.region = begin();
window.region.catch((fault) => say(fault.message));
