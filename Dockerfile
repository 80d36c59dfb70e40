# phasefill in a container: docker build -t phasefill .
#     docker run --rm -v "$PWD:/work" phasefill fill part.stl -o filled.stl
# EXTRAS are those of pyproject.toml: docker build --build-arg EXTRAS=medical,scale -t phasefill .
FROM python:3.13-slim AS build
ARG EXTRAS=
COPY pyproject.toml README.md CHANGELOG.md LICENSE /source/
COPY infill /source/infill
COPY patterns /source/patterns
COPY docs/pictures/gallery /source/docs/pictures/gallery
COPY examples/cura /source/examples/cura
RUN python -m venv /opt/phasefill \
    && /opt/phasefill/bin/pip install --no-cache-dir "/source[${EXTRAS}]" \
    && /opt/phasefill/bin/pip uninstall --yes pip

FROM python:3.13-slim
COPY --from=build /opt/phasefill /opt/phasefill
# Compiled code lies in a folder that every user may write to; mount a volume there, and later runs begin at once.
RUN mkdir --mode=1777 /var/cache/phasefill && useradd --uid 1000 --create-home maker
ENV PATH=/opt/phasefill/bin:$PATH NUMBA_CACHE_DIR=/var/cache/phasefill
USER 1000
WORKDIR /work
ENTRYPOINT ["infill"]
CMD ["--help"]
