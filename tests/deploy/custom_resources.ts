// Of the resources that operators bring, what the manifests and the handbook use, by the operators' API
// references. Kubernetes' own types come from its schemas.

import type { LabelSelector, ObjectMeta } from 'kubernetes-types/meta/v1';

// Prometheus operator, monitoring.coreos.com/v1.
export interface ServiceMonitor {
  apiVersion: 'monitoring.coreos.com/v1';
  kind: 'ServiceMonitor';
  metadata: ObjectMeta;
  spec: {
    selector: LabelSelector;
    namespaceSelector?: { any?: boolean; matchNames?: string[] };
    endpoints: { port?: string; path?: string; interval?: string; scrapeTimeout?: string }[];
  };
}

// KEDA, keda.sh/v1alpha1.
export interface ScaledObject {
  apiVersion: 'keda.sh/v1alpha1';
  kind: 'ScaledObject';
  metadata: ObjectMeta;
  spec: {
    scaleTargetRef: { apiVersion?: string; kind?: string; name: string };
    minReplicaCount?: number;
    maxReplicaCount?: number;
    pollingInterval?: number;
    cooldownPeriod?: number;
    triggers: { type: string; metadata: Record<string, string> }[];
  };
}
