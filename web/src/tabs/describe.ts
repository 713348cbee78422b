/** The machine as its file says it is: picture, chain, axes to drag, its errors, where the deviation comes from. */

import { tr } from "../words/index.ts";
import type { Tab } from "../app.ts";
import { DescribeTab } from "./describe/tab.ts";

export const describe: Tab = {
  title: tr`Describe`,
  mount: (host, app) => new DescribeTab(host, app),
};
