// The two workers, which follow the camera and search in the background.
export class Place {
  // maps: of the show's places; they are handed over. program: the tracker's, compiled.
  constructor(maps, program) {
    const fail = ({message}) => this.onerror(new Error(message ?? 'a worker has ended'));
    const [tracker, searcher] = ['tracker_worker.js', 'search_worker.js'].map((file) => {
      const worker = new Worker(new URL(file, import.meta.url), {type: 'module'});
      worker.onerror = fail;
      return worker;
    });
    this.tracker = tracker;
    const {port1, port2} = new MessageChannel();
    searcher.postMessage({maps, program, port: port1}, [port1]);
    this.ready = new Promise((resolve, reject) => {
      this.onerror = reject;
      tracker.onmessage = ({data}) => {
        if (data.error !== undefined) {
          this.onerror(new Error(data.error));
        } else if (data.ready) {
          resolve();
        } else if (data.tracked) {
          this.ontracked(data);
        }
      };
    });
    tracker.postMessage({maps, program, search: port2}, [port2, ...maps.map((map) => map.buffer)]);
  }

  track(number, image, seconds) {
    this.tracker.postMessage({number, image, seconds}, [image.data.buffer]);
  }

  // occluders: Show.occluders().
  setOccluders(occluders) {
    this.tracker.postMessage({occluders});
  }

  relocalize() {
    this.tracker.postMessage({relocalize: true});
  }
}
