/**
 * Sends only the latest of many requests (a slider): one under way, at most one waiting.
 * `answered` is called with every answer that came, in order.
 */
export function latestOnly<B, R>(
  send: (body: B) => Promise<R>,
  answered: (reply: R, body: B) => void,
  failed: (error: unknown) => void,
): (body: B) => void {
  let busy = false;
  let waiting: B | null = null;
  const run = async (body: B): Promise<void> => {
    busy = true;
    try {
      answered(await send(body), body);
    } catch (error) {
      failed(error);
    }
    busy = false;
    if (waiting !== null) {
      const next = waiting;
      waiting = null;
      void run(next);
    }
  };
  return (body) => {
    if (busy) waiting = body;
    else void run(body);
  };
}
