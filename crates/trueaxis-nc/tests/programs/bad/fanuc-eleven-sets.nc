(ten sets of I J K, no more)
G65 P1 I1. I1. I1. I1. I1. I1. I1. I1. I1. I1. I1.
M30
