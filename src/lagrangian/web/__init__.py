"""The local app: a page in the browser for one person on this computer, and the server that answers it.

The server listens on 127.0.0.1 alone, and no route of it reads or writes a path. A model is a text in a request, which
a process with limits on time and memory reads, derives or runs (`worker`, `pool`); the server itself (`app`, `guard`)
only passes texts on, and imports neither SymPy nor machine code.
"""
