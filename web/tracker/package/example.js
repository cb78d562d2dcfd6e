// A cube in a trained place, with three.js: image, canvas and map come from the page.
import * as THREE from 'three';
import {projectionMatrix, Tracker, viewMatrix} from 'lararium-tracker';

export async function start(video, canvas, mapUrl) {
  const map = new Uint8Array(await (await fetch(mapUrl)).arrayBuffer());
  const tracker = await Tracker.create({maps: [map]});
  const renderer = new THREE.WebGLRenderer({canvas, alpha: true});
  const scene = new THREE.Scene().add(new THREE.Mesh(new THREE.BoxGeometry(), new THREE.MeshNormalMaterial()));
  const camera = Object.assign(new THREE.PerspectiveCamera(), {matrixAutoUpdate: false});
  video.requestVideoFrameCallback(async function draw(now, {mediaTime}) {
    const frame = new VideoFrame(video);
    const data = new Uint8Array(frame.allocationSize());
    const [{offset, stride}] = await frame.copyTo(data);  // The luminance is the first plane.
    const {width, height} = frame.visibleRect;
    frame.close();
    const tracked = tracker.track({data: data.subarray(offset), width, height, stride}, mediaTime);
    if (tracked.pose) {
      camera.projectionMatrix.fromArray(projectionMatrix(tracked.camera, 0.01, 100));
      camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
      camera.matrixWorld.fromArray(viewMatrix(tracked.pose)).invert();
      camera.matrixWorldInverse.fromArray(viewMatrix(tracked.pose));
      renderer.render(scene, camera);
    }
    video.requestVideoFrameCallback(draw);
  });
}
