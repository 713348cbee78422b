/** The machine as its file says it is: picture, chain, axes to drag, its errors, where the deviation comes from. */

import type { Tab } from "../app.ts";
import { DescribeTab } from "./describe/tab.ts";

export const describe: Tab = {
  title: "Describe",
  mount: (host, app) => new DescribeTab(host, app),
};
