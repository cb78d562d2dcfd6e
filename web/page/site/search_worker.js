// Locates images without a prior for tracker_worker.js, which goes on meanwhile. Takes {maps, program, port} first; from the port it
// takes {asked, question} and says {asked, answer} or {error}.
import {Searcher} from './lararium-tracker/lararium-tracker.js';

onmessage = ({data: {maps, program, port}}) => {
  const searcher = Searcher.create({maps, program});
  port.onmessage = async ({data: {asked, question}}) => {
    try {
      const answer = (await searcher).find(question);
      port.postMessage({asked, answer}, [answer.buffer]);
    } catch (error) {
      port.postMessage({error: error.message});
    }
  };
};
